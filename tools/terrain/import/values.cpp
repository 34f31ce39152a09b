#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <utility>

#include "components/errors/exit_error.h"
#include "tools/terrain/import/survey_file.h"

namespace ensonify::terrain_import {
namespace {

/// What files without a nodata entry write for "no value".
constexpr std::array kUsualMarks = {-9999.0, 9999.0, -99999.0, 99999.0, -32768.0, 32767.0, 1e6, -1e6};
/// What they write too, but a seabed may have: a mark where all else is far from it.
constexpr std::array kPossibleMarks = {0.0, -10.0, 10.0, -99.0, 99.0, -999.0, 999.0};
constexpr double kDeepest_m = 11'500.0, kHighest_m = 9'000.0;
constexpr double kOverrun = 60'000.0;  // between neighbours: 16 bits that ran over differ by 65,536 less the relief

struct Unit {
  const char* names;  // as users and files write it, each between blanks
  double metres;
};
constexpr std::array kUnits = {Unit{" m metre metres meter meters ", 1.0},
                               Unit{" dm decimetre decimeter ", 0.1},
                               Unit{" cm centimetre centimetres centimeter centimeters ", 0.01},
                               Unit{" mm millimetre millimetres millimeter millimeters ", 0.001},
                               Unit{" ft foot feet international_foot ", 0.3048},
                               Unit{" us-ft ftus us_survey_foot us_survey_feet ", 1200.0 / 3937.0},
                               Unit{" fathom fathoms fath ", 1.8288}};

struct Range {
  double lowest = std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::lowest();
  std::int64_t known = 0, negative = 0;
};

Range range_of(std::span<const float> values) {
  Range range;
  for (const float value : values) {
    if (std::isnan(value)) continue;
    range.lowest = std::min<double>(range.lowest, value);
    range.highest = std::max<double>(range.highest, value);
    ++range.known;
    range.negative += value < 0.0F ? 1 : 0;
  }
  return range;
}

/// 16 bits that ran over leave neighbours almost 2^16 apart.
void refuse_overrun(const source::RasterFile& file, std::span<const float> values) {
  if (!file.hints().whole_numbers) return;
  const auto columns = static_cast<std::size_t>(file.columns());
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (i % columns == 0 || !(std::abs(values[i] - values[i - 1]) > kOverrun)) continue;
    file.refuse(
        fmt::format("jumps from {} to {} between columns {} and {} of row {}: whole numbers of 16 bits that ran over, "
                    "or a mark for "
                    "missing values that is not declared (--nodata); write such heights as 32-bit or real numbers",
                    values[i - 1], values[i], i % columns - 1, i % columns, i / columns));
  }
}

/// A value that is often a mark, that stands at an end of the range, and from which all others are farther off than
/// half of what they span and than 1: a plateau of land at 0 has beaches, a mark has none.
void refuse_lonely_marks(const source::RasterFile& file, std::span<const float> values, const Range& range) {
  for (const double mark : kPossibleMarks) {
    if (range.lowest == range.highest || (range.lowest != mark && range.highest != mark)) continue;
    double nearest = range.lowest == mark ? range.highest : range.lowest, farthest = nearest;
    std::int64_t count = 0;
    for (const float value : values) {
      if (std::isnan(value)) continue;
      const double v = value;
      if (v == mark) ++count;
      else if (std::abs(v - mark) < std::abs(nearest - mark)) nearest = v;
    }
    if (std::abs(nearest - mark) <= std::max(1.0, 0.5 * std::abs(farthest - nearest))) continue;
    file.refuse(fmt::format(
        "holds {:.6g} in {} cells and nothing else nearer to it than {:.6g}: a mark for missing values that "
        "is not declared as one? "
        "Declare it with --nodata {:.6g}; cells that are truly so deep are cut off, or given another value",
        mark, count, nearest, mark));
  }
}

bool states(const std::string& words, const char* word) { return words.find(word) != std::string::npos; }

/// True: down. Gives the reason, too.
std::pair<bool, std::string> sign_of(const source::RasterFile& file, const FileOptions& options, const Range& range) {
  if (options.positive == "up") return {false, "--positive up"};
  if (options.positive == "down") return {true, "--positive down"};
  const auto& hints = file.hints();
  const bool mostly_negative = 2 * range.negative > range.known;
  const bool down = hints.vertical_down || states(hints.words, "positive=down") || states(hints.words, "depth");
  const bool up = states(hints.words, "positive=up") || states(hints.words, "elevation") ||
                  states(hints.words, "altitude") || states(hints.words, "height");
  const std::string choice =
      fmt::format(" (values from {:.6g} to {:.6g}); say which it is: --positive down for depths, up for elevations",
                  range.lowest, range.highest);
  if (mostly_negative && states(hints.words, "positive=down"))
    file.refuse("counts its values positive down, and most are negative" + choice);
  if (mostly_negative) return {false, "most values are negative"};  // read as depths they would be dry
  if (down == up) file.refuse("does not say whether its values are depths or elevations" + choice);
  return {down, "the file says so"};
}

/// Heights of other planets, with the unit that would explain them.
void refuse_range(const source::RasterFile& file, const Range& range, const std::string& unit) {
  if (range.lowest >= -kDeepest_m && range.highest <= kHighest_m) return;
  std::string advice;
  for (const auto& [name, metres] : {std::pair{"cm", 0.01}, {"mm", 0.001}}) {
    if (advice.empty() && range.lowest * metres >= -kDeepest_m && range.highest * metres <= kHighest_m)
      advice = fmt::format("; --units {} would make them {:.6g} to {:.6g} m", name, range.lowest * metres,
                           range.highest * metres);
  }
  file.refuse(
      fmt::format("holds heights from {:.6g} to {:.6g} m (unit {}); between -11500 and 9000 m are allowed{}, and a "
                  "mark for missing "
                  "values is declared with --nodata",
                  range.lowest, range.highest, unit, advice));
}

}  // namespace

double metres_in(const std::string& unit, const std::string& who) {
  std::string word = " ";
  for (const char letter : unit) {
    word += letter == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  word += ' ';
  for (const Unit& known : kUnits) {
    if (std::string(known.names).find(word) != std::string::npos) return known.metres;
  }
  throw UserError(who + ": unit " + unit + " is unknown; allowed are m, dm, cm, mm, ft, us-ft and fathom (--units)");
}

std::int64_t drop_marked(std::span<float> values, const std::vector<double>& marks) {
  std::int64_t dropped = 0;
  for (const double mark : marks) {
    for (float& value : values) {
      if (value != static_cast<float>(mark)) continue;
      value = std::numeric_limits<float>::quiet_NaN();
      ++dropped;
    }
  }
  return dropped;
}

void refuse_usual_marks(const source::RasterFile& file, double lowest, double highest) {
  std::string found;
  for (const double mark : kUsualMarks) {
    if (lowest == mark || highest == mark) found += (found.empty() ? "" : ",") + fmt::format("{:.6g}", mark);
  }
  if (found.empty()) return;
  file.refuse("holds " + found +
              ", which looks like a mark for missing values but is not declared as one; declare it with --nodata " +
              found);
}

ValueFacts elevations_of(const source::RasterFile& file, const FileOptions& options, std::span<float> values) {
  ValueFacts facts;
  facts.marked = drop_marked(values, options.nodata);
  const Range raw = range_of(values);
  if (raw.known == 0) file.refuse("holds no valid cell: all are nodata or NaN");
  refuse_usual_marks(file, raw.lowest, raw.highest);
  refuse_lonely_marks(file, values, raw);
  refuse_overrun(file, values);
  facts.unit = options.units != "auto" ? options.units : file.hints().unit.empty() ? "m" : file.hints().unit;
  facts.unit_m = metres_in(facts.unit, file.name());
  std::tie(facts.down, facts.down_why) = sign_of(file, options, raw);
  const double factor = facts.down ? -facts.unit_m : facts.unit_m;
  if (factor != 1.0) {
    for (float& value : values) value = static_cast<float>(value * factor);
  }
  const Range range = range_of(values);
  refuse_range(file, range, facts.unit);
  facts.lowest_m = range.lowest;
  facts.highest_m = range.highest;
  return facts;
}

std::optional<double> number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || end != text.c_str() + text.size()) return std::nullopt;
  return value;
}

std::vector<double> numbers_in(const std::string& text, const std::string& option, std::size_t least,
                               std::size_t most) {
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    const auto number = number_in(part);
    if (!number) throw UserError(fmt::format("{} {}: {} is no number", option, text, part));
    numbers.push_back(*number);
  }
  if (numbers.size() < least || numbers.size() > most) {
    throw UserError(fmt::format("{} {}: {} numbers are given, {} allowed (with commas between)", option, text,
                                numbers.size(),
                                least == most ? std::to_string(least) : fmt::format("{} to {}", least, most)));
  }
  return numbers;
}

FileOptions file_of(const std::string& words, FileOptions file) {
  const auto mark = words.find('?');
  file.path = words.substr(0, mark);
  if (mark == std::string::npos) return file;
  std::istringstream settings(words.substr(mark + 1));
  for (std::string setting; std::getline(settings, setting, '&');) {
    const auto equals = setting.find('=');
    const std::string key = setting.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
    const auto one = [&] { return numbers_in(value, words + ": " + key, 1, 1)[0]; };
    if (key == "crs") file.crs = value;
    else if (key == "positive" && (value == "up" || value == "down" || value == "auto")) file.positive = value;
    else if (key == "units") file.units = value;
    else if (key == "nodata") file.nodata = numbers_in(value, words + ": nodata", 1, 16);
    else if (key == "datum-shift") file.datum_shift_m = one();
    else if (key == "vertical") file.vertical = value;
    else if (key == "band" && one() >= 1 && one() <= 1000) file.band = static_cast<int>(one());
    else
      throw UserError(fmt::format(
          "{}: {} is not known; allowed behind `?` are crs, positive (up, down, auto), units, nodata, datum-shift, "
          "vertical and band, with & between",
          words, setting));
  }
  return file;
}

}  // namespace ensonify::terrain_import
