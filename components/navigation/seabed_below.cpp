#include "components/navigation/seabed_below.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace ensonify {
namespace {

constexpr double kHalfWidth_rad = 1e-3;

/// What a ray along a direction examines.
lod::View view_along(const frames::HeadPose& from, const frames::Vec3& direction, double longest_m) {
  lod::View view;
  lod::Frustum& cone = view.frustum;
  cone.apex_enu_m = from.position_enu_m;
  cone.axis_enu = (from.enu_from_head * direction).normalized();
  cone.zero_enu = cone.axis_enu.unitOrthogonal();
  cone.side_enu = cone.axis_enu.cross(cone.zero_enu);
  cone.low_sine = std::cos(kHalfWidth_rad);
  cone.low_angle_rad = -std::numbers::pi;
  cone.high_angle_rad = std::numbers::pi;
  cone.max_range_m = longest_m;
  return view;
}

}  // namespace

void SeabedBelow::connect(Ports& ports, bool optional) {
  ports.in<msg::Tile>("tile", [this](const msg::Tile& tile) { tiles_.insert(tile); }, {.optional = optional});
  ports.in<msg::TileRelease>("release", [this](const msg::TileRelease& tile) { tiles_.release(tile); },
                             {.optional = optional});
  ports.in<msg::Mesh>("mesh", [this](const msg::Mesh& mesh) { tiles_.insert(mesh); }, {.optional = true});
  ports.in<msg::MeshRelease>("mesh_release", [this](const msg::MeshRelease& mesh) { tiles_.release(mesh); },
                             {.optional = true});
}

std::optional<double> SeabedBelow::distance_m(const frames::HeadPose& from, const frames::Vec3& direction,
                                              double longest_m) {
  if (tiles_.scene().empty()) return std::nullopt;
  tiles_.scene().centre_near(from.position_enu_m.head<2>());
  tiles_.scene().adapt(std::array{view_along(from, direction, longest_m)});
  const trace::Rays ray{{direction.cast<float>(), 0.0F}};
  trace::Hits hit;
  tiles_.scene().trace(from, ray, static_cast<float>(longest_m), hit);
  if (!hit.hit(0)) return std::nullopt;
  return hit.range_m[0];
}

}  // namespace ensonify
