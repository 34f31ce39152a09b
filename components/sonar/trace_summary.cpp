#include "components/sonar/trace_summary.h"

#include <fmt/format.h>

namespace ensonify {

std::optional<double> altitude_m(const trace::Scene& seabed, const frames::HeadPose& head) {
  const auto height_m = seabed.height_m(head.position_enu_m.head<2>());
  if (!height_m || *height_m > head.position_enu_m.z()) return std::nullopt;
  return head.position_enu_m.z() - *height_m;
}

std::string no_echo_reason(const TraceSummary& trace_summary) {
  if (trace_summary.rays_in_lobe > 0) return "";
  if (!trace_summary.altitude_m) {
    return fmt::format("nothing within the range of {:.1f} m, and no seabed below the head: the terrain has a hole",
                       trace_summary.range_m);
  }
  if (*trace_summary.altitude_m > trace_summary.range_m) {
    return fmt::format("the range of {:.1f} m is below the altitude of {:.1f} m", trace_summary.range_m,
                       *trace_summary.altitude_m);
  }
  return fmt::format(
      "nothing within the range of {:.1f} m where the head points{}: it points over the seabed {:.1f} m "
      "below, or is mounted or tilted the wrong way",
      trace_summary.range_m, trace_summary.rays_that_hit > 0 ? " (side lobes hit something)" : "",
      *trace_summary.altitude_m);
}

}  // namespace ensonify
