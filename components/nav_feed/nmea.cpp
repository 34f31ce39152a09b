#include "components/nav_feed/nmea.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

namespace ensonify::nmea {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<std::string_view> fields_of(std::string_view body) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = body.find(',');
    fields.push_back(body.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    body.remove_prefix(comma + 1);
  }
}

/// A number from `least` to `most`, alone in its field; a plus before it is allowed, as PASHR has it.
std::optional<double> number(std::string_view text, double least, double most) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool good = error == std::errc{} && end == text.data() + text.size() && value >= least && value <= most;
  return good ? std::optional(value) : std::nullopt;
}

/// hhmmss.ss as seconds of the day.
std::optional<double> time_of_day_s(std::string_view text) {
  if (text.size() < 6) return std::nullopt;
  const auto hours = number(text.substr(0, 2), 0, 23), minutes = number(text.substr(2, 2), 0, 59);
  const auto seconds = number(text.substr(4), 0, 60.999);  // a leap second has the name 60
  if (!hours || !minutes || !seconds) return std::nullopt;
  return 3600.0 * *hours + 60.0 * *minutes + *seconds;
}

/// dddmm.mmm and its half of the globe, as degrees.
std::optional<double> angle_deg(std::string_view text, std::string_view half, char plus, char minus, double most_deg) {
  const auto packed = number(text, 0, 100.0 * most_deg);
  if (!packed || half.size() != 1 || (half[0] != plus && half[0] != minus)) return std::nullopt;
  const double degrees = std::floor(*packed / 100.0), minutes = *packed - 100.0 * degrees;
  if (minutes >= 60.0) return std::nullopt;
  return (half[0] == plus ? 1.0 : -1.0) * (degrees + minutes / 60.0);
}

/// The text between $ and *, or what is wrong.
std::variant<std::string_view, Sentence> body_of(std::string_view line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n' || line.back() == ' ')) line.remove_suffix(1);
  if (!line.starts_with('$')) return Sentence{Malformed{}};
  line.remove_prefix(1);
  const std::size_t star = line.rfind('*');
  if (star == std::string_view::npos || line.size() != star + 3) return Sentence{BadChecksum{}};
  unsigned reported = 0, sum = 0;
  const auto [end, error] = std::from_chars(line.data() + star + 1, line.data() + line.size(), reported, 16);
  for (const char c : line.substr(0, star)) sum ^= static_cast<unsigned char>(c);
  if (error != std::errc{} || end != line.data() + line.size() || reported != sum) return Sentence{BadChecksum{}};
  return line.substr(0, star);
}

Sentence read_fix(const std::vector<std::string_view>& f) {
  if (f.size() < 10) return Malformed{};
  const auto quality = number(f[6], 0, 9);
  if (!quality) return Malformed{};
  if (*quality == 0.0) return Fix{};
  const auto time_s = time_of_day_s(f[1]);
  const auto latitude = angle_deg(f[2], f[3], 'N', 'S', 90), longitude = angle_deg(f[4], f[5], 'E', 'W', 180);
  if (!time_s || !latitude || !longitude) return Malformed{};
  return Fix{*time_s,    static_cast<int>(*quality),         *latitude,
             *longitude, number(f[8], 0, 1e3).value_or(0.0), number(f[9], -1e4, 1e5)};
}

Sentence read_heading(const std::vector<std::string_view>& f) {
  if (f.size() < 3) return Malformed{};
  if (f[1].empty()) return Empty{};
  const auto heading_deg = number(f[1], 0, 360);
  return heading_deg && f[2] == "T" ? Sentence{Heading{*heading_deg * kDegree}} : Malformed{};
}

/// The fields of roll, pitch and heave, and that of heading.
struct Places {
  std::size_t roll, pitch, heave, heading;
};

Sentence read_motion(const std::vector<std::string_view>& f, const Places& at, std::optional<double> time_s) {
  if (f[at.roll].empty() || f[at.pitch].empty()) return Empty{};
  const auto roll_deg = number(f[at.roll], -180, 180), pitch_deg = number(f[at.pitch], -90, 90);
  const auto heave_m = f[at.heave].empty() ? std::optional(0.0) : number(f[at.heave], -100, 100);
  const auto heading_deg = number(f[at.heading], 0, 360);
  if (!roll_deg || !pitch_deg || !heave_m || (!heading_deg && !f[at.heading].empty())) return Malformed{};
  Motion motion{time_s, std::nullopt, *roll_deg * kDegree, *pitch_deg * kDegree, *heave_m};
  if (heading_deg) motion.true_heading_rad = *heading_deg * kDegree;
  return motion;
}

}  // namespace

Sentence parse(std::string_view line) {
  const auto body = body_of(line);
  if (const auto* wrong = std::get_if<Sentence>(&body)) return *wrong;
  const auto f = fields_of(std::get<std::string_view>(body));
  if (f[0] == "PASHR") {
    if (f.size() < 7) return Malformed{};
    if (f[1].empty()) return Empty{};
    const auto time_s = time_of_day_s(f[1]);
    return time_s ? read_motion(f, {4, 5, 6, 2}, time_s) : Malformed{};
  }
  if (f[0] == "PSXN" && f.size() > 1 && f[1] == "23") {
    return f.size() < 6 ? Malformed{} : read_motion(f, {2, 3, 5, 4}, std::nullopt);
  }
  const bool talker = f[0].size() == 5 && !f[0].starts_with('P');
  if (talker && f[0].ends_with("GGA")) return read_fix(f);
  if (talker && f[0].ends_with("HDT")) return read_heading(f);
  return Other{};
}

}  // namespace ensonify::nmea
