#include "components/formats/nmea/steering.h"

#include <numbers>

namespace ensonify::nmea {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kNauticalMile_m = 1852.0;
constexpr double kFarthest = 1000.0;  // in the sentence's unit

std::optional<Bearing> bearing(std::string_view value, std::string_view north) {
  const auto degrees = number(value, 0, 360);
  if (!degrees || (north != "T" && north != "M")) return std::nullopt;
  return Bearing{*degrees * kDegree, north == "M"};
}

/// Its magnitude, the side to steer to, and N for nautical miles or K for kilometres.
std::optional<double> off_m(std::string_view size, std::string_view steer_to, std::string_view unit) {
  const auto found = number(size, 0, kFarthest);
  const double metres = unit == "N" ? kNauticalMile_m : unit == "K" ? 1000.0 : 0.0;
  if (!found || metres == 0.0 || (steer_to != "L" && steer_to != "R")) return std::nullopt;
  return (steer_to == "L" ? 1.0 : -1.0) * *found * metres;
}

bool warns(std::string_view status) { return status == "V"; }
/// Newer sentences end in a mode.
bool is_void(const Fields& f, std::size_t mode) { return f.size() > mode && f[mode] == "N"; }

Steer read_heading_order(const Fields& f) {
  if (f.size() < 3) return Malformed{};
  if (f.size() > 4 && f[1].empty() && !f[3].empty()) {
    const auto magnetic = bearing(f[3], f[4]);
    return magnetic ? Steer{HeadingOrder{*magnetic}} : Malformed{};
  }
  if (f[1].empty()) return Empty{};
  const auto heading = bearing(f[1], f[2]);
  return heading ? Steer{HeadingOrder{*heading}} : Malformed{};
}

Steer read_apb(const Fields& f) {
  if (f.size() < 10) return Malformed{};
  if (warns(f[1]) || warns(f[2]) || is_void(f, 15)) return Warned{};
  if (f[3].empty() || f[8].empty()) return Empty{};
  const auto off = off_m(f[3], f[4], f[5]);
  const auto leg = bearing(f[8], f[9]);
  return off && leg ? Steer{LegOrder{*off, leg, {}, 0.0}} : Malformed{};
}

Steer read_xte(const Fields& f) {
  if (f.size() < 6) return Malformed{};
  if (warns(f[1]) || warns(f[2]) || is_void(f, 6)) return Warned{};
  if (f[3].empty()) return Empty{};
  const auto off = off_m(f[3], f[4], f[5]);
  return off ? Steer{LegOrder{*off, {}, {}, 0.0}} : Malformed{};
}

/// Its bearing is true, its distances are in nautical miles.
Steer read_rmb(const Fields& f) {
  if (f.size() < 12) return Malformed{};
  if (warns(f[1]) || is_void(f, 14)) return Warned{};
  if (f[2].empty() || f[10].empty() || f[11].empty()) return Empty{};
  const auto off = off_m(f[2], f[3], "N");
  const auto range = number(f[10], 0, kFarthest);
  const auto to_end = bearing(f[11], "T");
  return off && range && to_end ? Steer{LegOrder{*off, {}, to_end, *range * kNauticalMile_m}} : Malformed{};
}

}  // namespace

Steer read_steering(std::string_view line) {
  const auto found = fields_of(line);
  if (std::holds_alternative<BadChecksum>(found)) return BadChecksum{};
  if (std::holds_alternative<Malformed>(found)) return Malformed{};
  const Fields& f = std::get<Fields>(found);
  if (is_kind(f, "HSC")) return read_heading_order(f);
  if (is_kind(f, "APB")) return read_apb(f);
  if (is_kind(f, "XTE")) return read_xte(f);
  if (is_kind(f, "RMB")) return read_rmb(f);
  return Other{};
}

}  // namespace ensonify::nmea
