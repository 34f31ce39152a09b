#include "kernels/mesh/progressive/collapse.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <algorithm>
#include <stdexcept>

namespace ensonify::progressive {
namespace {

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
