#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernels/acoustics/trace/mesh.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/mesh/progressive/cut.h"

/// Irregular meshes of a scene. Private to this folder: it includes Embree.
namespace ensonify::trace {

/// Triangles of an irregular mesh that are neighbours.
class TrianglePart final : public Part {
 public:
  /// Base of all parts of a mesh.
  struct Common {
    std::uint32_t number = 0;  // as Hit has them
    float facet_m = 0.0F;
    std::uint8_t sediment = 0;
  };
  /// `places_m`: of all the mesh's vertices in Embree's frame, and room for one more, which Embree may read. They must
  /// outlive the part.
  TrianglePart(const Device& device, std::vector<progressive::Triangle> triangles,
               std::span<const Eigen::Vector3f> places_m, const Common& common);

  std::uint8_t sediment_at(const terrain::Vec2&) const override { return sediment_; }
  const std::vector<progressive::Triangle>& shown() const { return triangles_; }

 private:
  Content content() const override;

  std::vector<progressive::Triangle> triangles_;
  std::span<const Eigen::Vector3f> places_m_;
  std::uint8_t sediment_;
};

/// An irregular mesh as a scene has it. Its triangles are in clusters of neighbours, each a part, so that what stays
/// from ping to ping is not built again, and a part is so small that Embree builds it in the same way on however many
/// threads.
class Irregular {
 public:
  Irregular(IrregularMesh mesh, std::uint32_t number);

  /// As finely as these views ask for: of level 0 all of it, of level n to a tenth of 2^n mean edges.
  void choose(std::span<const lod::View> views);
  void choose_all();

  /// The parts of what has been chosen; those that are new are built.
  std::vector<const Part*> show(const Device& device, const terrain::Vec2& origin_enu_m);
  /// Builds all anew when they are next shown: the origin has moved.
  void forget();

  std::size_t triangles() const;
  const Eigen::AlignedBox3d& box_enu_m() const { return box_enu_m_; }

 private:
  struct Cluster {
    std::vector<progressive::Triangle> wanted;
    std::unique_ptr<TrianglePart> part;
  };
  void want(std::span<const progressive::Triangle> triangles, std::span<const std::uint32_t> sources);

  progressive::Hierarchy hierarchy_;
  TrianglePart::Common common_;  // facet_m: of the mean triangle
  Eigen::AlignedBox3d box_enu_m_;
  double edge_m_ = 0.0;                    // mean
  std::vector<std::uint32_t> cluster_of_;  // by source triangle
  std::vector<Eigen::Vector3f> places_m_;  // of vertices, in Embree's frame; empty while that is not known
  std::vector<Cluster> clusters_;
  progressive::Cut cut_;
};

}  // namespace ensonify::trace
