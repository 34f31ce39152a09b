#include "components/navigation/seabed_below.h"

#include <vector>

namespace ensonify {

void SeabedBelow::connect(Ports& ports, bool optional) {
  ports.in<msg::Tile>("tile", [this](const msg::Tile& tile) { tiles_.insert(tile); }, {.optional = optional});
  ports.in<msg::TileRelease>("release", [this](const msg::TileRelease& tile) { tiles_.release(tile); },
                             {.optional = optional});
}

std::optional<double> SeabedBelow::distance_m(const frames::HeadPose& from, const frames::Vec3& direction,
                                              double longest_m) const {
  if (tiles_.scene().empty()) return std::nullopt;
  const std::vector<trace::Ray> ray{{direction.cast<float>(), 0.0F}};
  std::vector<trace::Hit> hit;
  tiles_.scene().trace(from, ray, static_cast<float>(longest_m), hit);
  if (!hit[0].hit()) return std::nullopt;
  return hit[0].range_m;
}

}  // namespace ensonify
