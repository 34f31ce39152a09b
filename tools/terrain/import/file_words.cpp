#include "tools/terrain/import/file_words.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "components/errors/exit_error.h"

namespace ensonify::terrain_import {

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
