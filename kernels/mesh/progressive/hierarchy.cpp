#include "kernels/mesh/progressive/hierarchy.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace ensonify::progressive {
namespace {

/// A place of the plane over the way: how far along, and how high.
struct OnPlane {
  double along_m, z_m;
};

/// The least distance along the part of a chord that is on the way and at or above the height.
double least_along_m(OnPlane a, OnPlane b, double length_m, double least_z_m) {
  constexpr double kNone_m = std::numeric_limits<double>::infinity();
  if (a.along_m > b.along_m) std::swap(a, b);
  const double run_m = b.along_m - a.along_m, rise_m = b.z_m - a.z_m;
  double first = 0.0, last = 1.0;                            // shares of the chord
  const auto keep_above = [&](double value, double slope) {  // value + slope * share >= 0
    if (slope > 0.0) first = std::max(first, -value / slope);
    else if (slope < 0.0) last = std::min(last, -value / slope);
    else if (value < 0.0) last = -1.0;
  };
  keep_above(a.along_m, run_m);
  keep_above(length_m - a.along_m, -run_m);
  keep_above(a.z_m - least_z_m, rise_m);
  return first <= last ? a.along_m + first * run_m : kNone_m;
}

using Eigen::AlignedBox3f;
using Eigen::Vector3f;

/// Distance of a point from a triangle [Ericson2005, 5.1.5].
float distance_m(const Vector3f& p, const Vector3f& a, const Vector3f& b, const Vector3f& c) {
  const Vector3f ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0.0F && d2 <= 0.0F) return ap.norm();
  if (d3 >= 0.0F && d4 <= d3) return bp.norm();
  if (d6 >= 0.0F && d5 <= d6) return cp.norm();
  const float va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) return (ap - d1 / (d1 - d3) * ab).norm();
  if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) return (ap - d2 / (d2 - d6) * ac).norm();
  if (va <= 0.0F && d4 >= d3 && d5 >= d6) return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).norm();
  const float whole = va + vb + vc;
  return whole > 0.0F ? (ap - vb / whole * ab - vc / whole * ac).norm() : std::min(ap.norm(), bp.norm());
}

/// Follows the triangles while vertices are moved onto others.
class Shrinking {
 public:
  explicit Shrinking(const TriangleMesh& mesh)
      : mesh_(mesh), corners_(mesh.triangle), star_(mesh.vertex_m.size()), there_(mesh.vertex_m.size(), 1) {
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      for (const std::uint32_t corner : corners_[t]) star_[corner].push_back(t);
    }
  }

  /// The triangles that go.
  std::vector<std::uint32_t> collapse(const Collapse& one) {
    if (one.removed >= there_.size() || one.kept >= there_.size() || one.removed == one.kept ||
        there_[one.removed] == 0 || there_[one.kept] == 0)
      throw std::invalid_argument("hierarchy: a collapse names a vertex that is not there");
    there_[one.removed] = 0;
    std::vector<std::uint32_t> gone, moved;
    for (const std::uint32_t t : star_[one.removed]) {
      auto& corners = corners_[t];
      const bool both = std::find(corners.begin(), corners.end(), one.kept) != corners.end();
      (both ? gone : moved).push_back(t);
      if (!both) std::replace(corners.begin(), corners.end(), one.removed, one.kept);
    }
    for (const std::uint32_t t : gone) {
      for (const std::uint32_t corner : corners_[t]) {
        if (corner != one.removed) std::erase(star_[corner], t);
      }
    }
    star_[one.removed] = {};
    star_[one.kept].insert(star_[one.kept].end(), moved.begin(), moved.end());
    return gone;
  }

  /// Of a vertex from the triangles around another one; from that one itself if it has none.
  float distance_from_m(std::uint32_t vertex, std::uint32_t middle) const {
    const auto& at = mesh_.vertex_m;
    float least_m = (at[vertex] - at[middle]).norm();
    for (const std::uint32_t t : star_[middle]) {
      const auto& [a, b, c] = corners_[t];
      least_m = std::min(least_m, distance_m(at[vertex], at[a], at[b], at[c]));
    }
    return least_m;
  }

  /// Which are left, in order.
  std::vector<std::uint32_t> left() const {
    std::vector<std::uint32_t> triangles;
    for (const auto& star : star_) triangles.insert(triangles.end(), star.begin(), star.end());
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    return triangles;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<Triangle> corners_;
  std::vector<std::vector<std::uint32_t>> star_;  // triangles around each vertex
  std::vector<std::uint8_t> there_;
};

/// Around all triangles that have a vertex for a corner.
std::vector<AlignedBox3f> boxes_around(const TriangleMesh& mesh) {
  std::vector<AlignedBox3f> boxes(mesh.vertex_m.size());
  for (const Triangle& corners : mesh.triangle) {
    for (const std::uint32_t corner : corners) {
      for (const std::uint32_t other : corners) boxes[corner].extend(mesh.vertex_m[other]);
    }
  }
  for (std::size_t v = 0; v < boxes.size(); ++v) boxes[v].extend(mesh.vertex_m[v]);
  return boxes;
}

/// Bottom up: children have higher numbers.
void bound(Hierarchy& hierarchy) {
  const std::vector<AlignedBox3f> around = boxes_around(hierarchy.mesh);
  for (auto split = hierarchy.splits.rbegin(); split != hierarchy.splits.rend(); ++split) {
    split->box_m = around[split->removed];
    for (const std::int32_t child : split->child) {
      if (child != kNone) split->box_m.extend(hierarchy.splits[static_cast<std::size_t>(child)].box_m);
    }
  }
}

using Surface = OpenMesh::TriMesh_ArrayKernelT<>;
using Quadric = Eigen::Matrix4d;  // squared distances from planes: p^T Q p, p = (x, y, z, 1)

/// OpenMesh gives the error stream of each triangle that it refuses; that is no news here.
class Quiet {
 public:
  Quiet() { ::omerr().disable(); }
  ~Quiet() { ::omerr().enable(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

Surface surface_of(const TriangleMesh& mesh) {
  const Quiet quiet;
  Surface surface;
  for (const Eigen::Vector3f& v : mesh.vertex_m) surface.add_vertex({v.x(), v.y(), v.z()});
  const auto vertex = [](std::uint32_t number) { return OpenMesh::VertexHandle(static_cast<int>(number)); };
  for (const auto& [a, b, c] : mesh.triangle) surface.add_face(vertex(a), vertex(b), vertex(c));
  return surface;
}

/// What a collapse costs: squared distances from the planes of the triangles that a vertex stands for, weighted by
/// their areas [Garland1997], and from planes through the surface's outline, upright on it. Keeps the list of what was
/// done.
template <class MeshT>
class Cost : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(Cost, MeshT, Cost)

  explicit Cost(Mesh& mesh) : Base(mesh, false) {}

  void initialize() override {
    quadrics_.assign(Base::mesh().n_vertices(), Quadric::Zero());
    for (const auto edge : Base::mesh().halfedges()) {
      if (edge.is_boundary()) continue;
      const Eigen::Vector3d from = point(edge.from()), along = point(edge.to()) - from;
      const Eigen::Vector3d across =
          along.cross(point(edge.next().to()) - from);  // its length is twice the triangle's area
      const double area2 = across.norm();
      if (!(area2 > 0.0)) continue;
      const Eigen::Vector3d normal = across / area2;
      add(plane(normal, from, 0.5 * area2), {edge.from()});  // three half edges: each corner once
      if (edge.opp().is_boundary())
        add(plane(normal.cross(along).normalized(), from, along.squaredNorm()), {edge.from(), edge.to()});
    }
  }

  /// Where nothing is lost the shorter edge goes first.
  float collapse_priority(const CollapseInfo& collapse) override {
    const Eigen::Vector4d kept = point(collapse.v1).homogeneous();
    const double lost = kept.dot((of(collapse.v0) + of(collapse.v1)) * kept);
    const double length_m = (point(collapse.v1) - point(collapse.v0)).norm();
    return static_cast<float>(std::max(0.0, lost) + 1e-9 * length_m * length_m);
  }

  void postprocess_collapse(const CollapseInfo& collapse) override {
    of(collapse.v1) += of(collapse.v0);
    done_.push_back({static_cast<std::uint32_t>(collapse.v0.idx()), static_cast<std::uint32_t>(collapse.v1.idx())});
  }

  const std::vector<Collapse>& done() const { return done_; }

 private:
  Quadric& of(OpenMesh::VertexHandle vertex) { return quadrics_[static_cast<std::size_t>(vertex.idx())]; }
  Eigen::Vector3d point(OpenMesh::VertexHandle vertex) {
    const auto& p = Base::mesh().point(vertex);
    return Eigen::Vector3f(p[0], p[1], p[2]).cast<double>();
  }
  static Quadric plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& through, double weight) {
    const Eigen::Vector4d p(normal.x(), normal.y(), normal.z(), -normal.dot(through));
    return weight * p * p.transpose();
  }
  void add(const Quadric& quadric, std::initializer_list<OpenMesh::VertexHandle> vertices) {
    for (const auto vertex : vertices) of(vertex) += quadric;
  }

  std::vector<Quadric> quadrics_;
  std::vector<Collapse> done_;
};

}  // namespace

std::string fault_of(const TriangleMesh& mesh) {
  if (!mesh.origin_enu_m.allFinite()) return "the origin is not finite";
  for (std::size_t v = 0; v < mesh.vertex_m.size(); ++v) {
    if (!mesh.vertex_m[v].allFinite()) return "vertex " + std::to_string(v) + " is not finite";
  }
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    const auto& [a, b, c] = mesh.triangle[t];
    if (a >= mesh.vertex_m.size() || b >= mesh.vertex_m.size() || c >= mesh.vertex_m.size())
      return "triangle " + std::to_string(t) + " has a corner that is no vertex";
    if (a == b || b == c || c == a) return "triangle " + std::to_string(t) + " has a corner twice";
  }
  return "";
}

lod::Sphere sphere_around(const Eigen::AlignedBox3f& box_m, const frames::Vec3& origin_enu_m) {
  const frames::Vec3 low = box_m.min().cast<double>(), high = box_m.max().cast<double>();
  return {origin_enu_m + 0.5 * (low + high), 0.5 * (high - low).norm() + kSlack_m};
}

std::optional<double> first_crossing_m(const TriangleMesh& mesh, const Way& way) {
  const frames::Vec2 over = way.to_enu_m - way.from_enu_m;
  const double length_m = over.norm(), least_z_m = way.above_z_m - kSlack_m - mesh.origin_enu_m.z();
  if (!(length_m > 0.0)) return std::nullopt;
  const frames::Vec2 along = over / length_m, beside(along.y(), -along.x());
  const frames::Vec2 start = way.from_enu_m - mesh.origin_enu_m.head<2>();
  double first_m = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : mesh.triangle) {
    std::array<double, 3> off_m{};
    std::array<OnPlane, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i) {
      const frames::Vec3 place = mesh.vertex_m[triangle[i]].cast<double>();
      const frames::Vec2 from_start = place.head<2>() - start;
      off_m[i] = from_start.dot(beside);
      corner[i] = {from_start.dot(along), place.z()};
    }
    // Two sides at most have their ends on different sides of the plane, where on it counts as beyond it.
    std::array<OnPlane, 3> crossings{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if ((off_m[i] < 0.0) == (off_m[j] < 0.0)) continue;
      const double share = off_m[i] / (off_m[i] - off_m[j]);
      crossings[count++] = {std::lerp(corner[i].along_m, corner[j].along_m, share),
                            std::lerp(corner[i].z_m, corner[j].z_m, share)};
    }
    if (count == 2) first_m = std::min(first_m, least_along_m(crossings[0], crossings[1], length_m, least_z_m));
  }
  if (!std::isfinite(first_m)) return std::nullopt;
  return first_m;
}

Hierarchy hierarchy_of(TriangleMesh mesh, std::span<const Collapse> collapses) {
  if (const std::string fault = fault_of(mesh); !fault.empty()) throw std::invalid_argument("mesh: " + fault);
  const auto count = static_cast<std::int32_t>(collapses.size());
  Hierarchy made;
  made.splits.resize(collapses.size());
  made.split_of.assign(mesh.vertex_m.size(), kNone);
  std::vector<std::int32_t> last(mesh.vertex_m.size(), kNone);  // split, of the latest collapse into a vertex
  Shrinking shrinking(mesh);
  for (std::int32_t s = count - 1; s >= 0; --s) {  // the finest is collapsed first and comes back last
    const Collapse& one = collapses[static_cast<std::size_t>(count - 1 - s)];
    Split& split = made.splits[static_cast<std::size_t>(s)];
    const auto gone = shrinking.collapse(one);
    split.removed = one.removed;
    split.kept = one.kept;
    split.child = {last[one.kept], last[one.removed]};
    split.first_born = static_cast<std::uint32_t>(made.born.size());
    split.born = static_cast<std::uint32_t>(gone.size());
    made.born.insert(made.born.end(), gone.begin(), gone.end());
    float below_m = 0.0F;
    for (const std::int32_t child : split.child) {
      if (child == kNone) continue;
      Split& finer = made.splits[static_cast<std::size_t>(child)];
      finer.parent = s;
      below_m = std::max(below_m, finer.deviation_m);
    }
    split.deviation_m = below_m + shrinking.distance_from_m(one.removed, one.kept);
    made.split_of[one.removed] = s;
    last[one.kept] = s;
  }
  made.coarsest = shrinking.left();
  made.mesh = std::move(mesh);
  bound(made);
  return made;
}

Hierarchy placed(Hierarchy hierarchy, const frames::Vec3& by_enu_m, double clockwise_rad) {
  return placed(std::move(hierarchy), by_enu_m,
                Eigen::AngleAxisd(-clockwise_rad, frames::Vec3::UnitZ()).toRotationMatrix());
}

Hierarchy placed(Hierarchy hierarchy, const frames::Vec3& by_enu_m, const Eigen::Matrix3d& turn) {
  TriangleMesh& mesh = hierarchy.mesh;
  const frames::Vec3 origin_enu_m = turn * mesh.origin_enu_m + by_enu_m;
  for (Eigen::Vector3f& vertex : mesh.vertex_m) vertex = (turn * vertex.cast<double>()).cast<float>();
  mesh.origin_enu_m = origin_enu_m;
  bound(hierarchy);
  return hierarchy;
}

std::string fault_of(const Hierarchy& hierarchy) {
  if (const std::string fault = fault_of(hierarchy.mesh); !fault.empty()) return fault;
  const std::size_t vertices = hierarchy.mesh.vertex_m.size(), triangles = hierarchy.mesh.triangle.size();
  const auto count = static_cast<std::int32_t>(hierarchy.splits.size());
  if (hierarchy.split_of.size() != vertices) return "not every vertex has an entry in split_of";
  for (std::int32_t s = 0; s < count; ++s) {
    const Split& split = hierarchy.splits[static_cast<std::size_t>(s)];
    const bool there = split.removed < vertices && split.kept < vertices && split.removed != split.kept &&
                       split.parent >= kNone && split.parent < s &&
                       std::size_t{split.first_born} + split.born <= hierarchy.born.size();
    const bool children = std::all_of(split.child.begin(), split.child.end(), [&](std::int32_t child) {
      return child == kNone || (s < child && child < count);
    });
    if (!there || !children || hierarchy.split_of[split.removed] != s || !std::isfinite(split.deviation_m) ||
        !split.box_m.min().allFinite() || !split.box_m.max().allFinite())
      return "split " + std::to_string(s) + " does not fit the others";
    const std::int32_t above = hierarchy.split_of[split.kept];
    if (above >= s) return "split " + std::to_string(s) + " goes to a vertex that comes back later";
  }
  const auto brought = std::count_if(hierarchy.split_of.begin(), hierarchy.split_of.end(),
                                     [](std::int32_t split) { return split != kNone; });
  if (brought != count) return "a vertex comes back by a split that is not its own";
  if (hierarchy.coarsest.size() + hierarchy.born.size() != triangles) return "triangles do not come once each";
  std::vector<std::uint8_t> comes(triangles, 0);
  for (const auto* list : {&hierarchy.coarsest, &hierarchy.born}) {
    for (const std::uint32_t triangle : *list) {
      if (triangle >= triangles || comes[triangle]++ != 0) return "triangles do not come once each";
    }
  }
  return "";
}

std::vector<Collapse> collapses_of(const TriangleMesh& mesh) {
  if (const std::string fault = fault_of(mesh); !fault.empty()) throw std::invalid_argument("mesh: " + fault);
  Surface surface = surface_of(mesh);
  OpenMesh::Decimater::DecimaterT<Surface> decimater(surface);
  Cost<Surface>::Handle cost;
  decimater.add(cost);
  decimater.initialize();
  decimater.decimate();
  return decimater.module(cost).done();
}

}  // namespace ensonify::progressive
