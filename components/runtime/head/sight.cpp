#include "components/runtime/head/sight.h"

#include <fmt/format.h>

#include <array>
#include <vector>

namespace ensonify {
namespace {

constexpr float kDeepest_m = 12000.0F;

}  // namespace

std::optional<double> altitude_m(const trace::Scene& seabed, const frames::HeadPose& head) {
  const frames::Vec3 down = head.enu_from_head.conjugate() * -frames::Vec3::UnitZ();
  const std::array<trace::Ray, 1> ray{trace::Ray{down.cast<float>(), 0.0F}};
  std::vector<trace::Hit> hits;
  seabed.trace(head, ray, kDeepest_m, hits);
  if (!hits[0].hit()) return std::nullopt;
  return hits[0].range_m;
}

std::string why_black(const Sight& sight) {
  if (sight.rays_in_lobe > 0) return "";
  if (!sight.altitude_m) {
    return fmt::format("nothing within the range of {:.1f} m, and no seabed below the head: the terrain has a hole",
                       sight.range_m);
  }
  if (*sight.altitude_m > sight.range_m) {
    return fmt::format("the range of {:.1f} m is below the altitude of {:.1f} m", sight.range_m, *sight.altitude_m);
  }
  return fmt::format(
      "nothing within the range of {:.1f} m where the head looks{}: it looks over the seabed {:.1f} m "
      "below, or is mounted or tilted the wrong way",
      sight.range_m, sight.rays_that_hit > 0 ? " (side lobes meet something)" : "", *sight.altitude_m);
}

}  // namespace ensonify
