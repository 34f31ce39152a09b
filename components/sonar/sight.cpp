#include "components/sonar/sight.h"

#include <fmt/format.h>

namespace ensonify {

std::optional<double> altitude_m(const trace::Scene& seabed, const frames::HeadPose& head) {
  const auto height_m = seabed.height_m(head.position_enu_m.head<2>());
  if (!height_m || *height_m > head.position_enu_m.z()) return std::nullopt;
  return head.position_enu_m.z() - *height_m;
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
