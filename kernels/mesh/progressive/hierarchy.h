#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
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

/// A vertex that is moved onto a neighbour; the triangles between the two are gone.
struct Collapse {
  std::uint32_t removed = 0;
  std::uint32_t kept = 0;

  bool operator==(const Collapse&) const = default;
};

/// The collapses that take a mesh to its coarsest, those that change its shape least first (quadric errors
/// [Garland1997], by OpenMesh). The surface keeps its topology and its boundary stays on the boundary, as long as all
/// are done in this order. A triangle that would make an edge have three sides is no part of this, and is carried along
/// by its corners. Throws std::invalid_argument with fault_of.
std::vector<Collapse> collapses_of(const TriangleMesh& mesh);

constexpr std::int32_t kNone = -1;

/// A collapse undone: brings a vertex back. It can be undone once its parent is; two at most have it for parent, the
/// collapse into the same vertex before it, and the last one into the vertex that it removes.
struct Split {
  std::uint32_t removed = 0, kept = 0;  // vertices
  std::int32_t parent = kNone;          // a split of lower number
  std::array<std::int32_t, 2> child = {kNone, kNone};
  std::uint32_t first_born = 0, born = 0;  // triangles that come back with it, in Hierarchy::born
  float deviation_m = 0.0F;   // of the removed vertex from the surface without it, and what its children add: an
                              // estimate of the distance between the surfaces; never less than a child's
  Eigen::AlignedBox3f box_m;  // of all source triangles that change when this or a split below it is not undone
};

/// A mesh and the tree of its splits. Any set of splits that holds the parent of each split that it holds is a
/// surface: source triangles whose corners have become one are left out, others stand on what their corners have
/// become. So two triangles that shared an edge still do, and there is no crack, whatever the set [Luebke1997].
struct Hierarchy {
  TriangleMesh mesh;
  std::vector<Split> splits;            // coarsest first
  std::vector<std::uint32_t> born;      // source triangles by the split that brings them
  std::vector<std::uint32_t> coarsest;  // source triangles that are there without any split
  std::vector<std::int32_t> split_of;   // by vertex: the split that brings it back; kNone: always there
};

/// Throws std::invalid_argument with fault_of, or when a collapse names a vertex that is gone.
Hierarchy hierarchy_of(TriangleMesh mesh, std::span<const Collapse> collapses);

/// The same surface elsewhere: turned about the vertical through its origin, clockwise as seen from above, and moved.
/// Vertices are rounded to float once more, boxes are those of the vertices as they then are.
Hierarchy placed(Hierarchy hierarchy, const frames::Vec3& by_enu_m, double clockwise_rad);
/// The same with any rotation about its origin.
Hierarchy placed(Hierarchy hierarchy, const frames::Vec3& by_enu_m, const Eigen::Matrix3d& turn);

/// Fault of a hierarchy that came from elsewhere; empty if nothing is wrong. Allowed is what hierarchy_of
/// makes: a mesh without fault, numbers of things that are there, parents before children.
std::string fault_of(const Hierarchy& hierarchy);

}  // namespace ensonify::progressive
