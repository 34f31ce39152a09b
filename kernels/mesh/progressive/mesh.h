#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernels/base/frames/attitude.h"
#include "kernels/mesh/lod/hierarchy.h"

/// View-dependent level of detail of irregular meshes (docs/physics/mesh/irregular-meshes.md).
namespace ensonify::progressive {

/// Numbers of three vertices.
using Triangle = std::array<std::uint32_t, 3>;

/// A surface of triangles of any shape: a survey as a TIN, a quay wall, a scanned coral. Triangles that share an edge
/// share its two vertices.
struct TriangleMesh {
  frames::Vec3 origin_enu_m = frames::Vec3::Zero();  // what the vertices count from; near them: they are float
  std::vector<Eigen::Vector3f> vertex_m;
  std::vector<Triangle> triangle;
};

/// Chords stay within 1 mm of their arcs, and coordinates are rounded by 0.13 mm (kernels/acoustics/trace/scene.h).
constexpr double kSlack_m = 2e-3;

/// Fault of a mesh; empty if nothing is wrong. Allowed are finite vertices and triangles of three different
/// ones; a mesh of no triangles is as good as any.
std::string fault_of(const TriangleMesh& mesh);

/// Around a box, from its middle to its corners; kSlack_m more than it needs, for what floats round and the chords of
/// refracted rays leave out.
lod::Sphere sphere_around(const Eigen::AlignedBox3f& box_m, const frames::Vec3& origin_enu_m);

/// A straight way seen from above, and the height from which up nothing may stand in it.
struct Way {
  frames::Vec2 from_enu_m = frames::Vec2::Zero();
  frames::Vec2 to_enu_m = frames::Vec2::Zero();
  double above_z_m = 0.0;
};

/// Distance along a track (m) at which the surface first crosses it: cuts the upright plane over it at or above its
/// height, at whatever height above. Empty when it does not. What comes within kSlack_m of the height does; a surface
/// that only touches the way from the side, with an upright triangle along it, may or may not. Exact but for what
/// floats round.
std::optional<double> first_crossing_m(const TriangleMesh& mesh, const Way& way);

}  // namespace ensonify::progressive
