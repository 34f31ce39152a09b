#include "components/formats/nmea/navigation.h"

#include <cmath>
#include <numbers>

namespace ensonify::nmea {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

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

Navigation read_fix(const Fields& f) {
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

Navigation read_heading(const Fields& f) {
  if (f.size() < 3) return Malformed{};
  if (f[1].empty()) return Empty{};
  const auto heading_deg = number(f[1], 0, 360);
  return heading_deg && f[2] == "T" ? Navigation{Heading{*heading_deg * kDegree}} : Malformed{};
}

/// The fields of roll, pitch and heave, and that of heading.
struct Places {
  std::size_t roll, pitch, heave, heading;
};

Navigation read_motion(const Fields& f, const Places& at, std::optional<double> time_s) {
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

Navigation read_navigation(std::string_view line) {
  const auto found = fields_of(line);
  if (std::holds_alternative<BadChecksum>(found)) return BadChecksum{};
  if (std::holds_alternative<Malformed>(found)) return Malformed{};
  const Fields& f = std::get<Fields>(found);
  if (f[0] == "PASHR") {
    if (f.size() < 7) return Malformed{};
    if (f[1].empty()) return Empty{};
    const auto time_s = time_of_day_s(f[1]);
    return time_s ? read_motion(f, {4, 5, 6, 2}, time_s) : Malformed{};
  }
  if (f[0] == "PSXN" && f.size() > 1 && f[1] == "23") {
    return f.size() < 6 ? Malformed{} : read_motion(f, {2, 3, 5, 4}, std::nullopt);
  }
  if (is_kind(f, "GGA")) return read_fix(f);
  if (is_kind(f, "HDT")) return read_heading(f);
  return Other{};
}

}  // namespace ensonify::nmea
