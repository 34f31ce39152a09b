#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/lod/cover.h"
#include "kernels/lod/frustum.h"
#include "kernels/progressive/hierarchy.h"

namespace ensonify::progressive {

/// Where a mesh matters, and how far the surface may be off there; 0: not at all.
struct View {
  lod::Frustum frustum;
  double tolerance_m = 0.0;
};

/// Of the sides of its triangles; 0 without any.
double mean_edge_m(const TriangleMesh& mesh);

/// Views of tiles as views of a mesh beside them: nothing off at level 0; at level n, which sees every 2^n-th post,
/// 2^n tenths of the mesh's mean edge.
std::vector<View> views_of(std::span<const lod::View> views, double mean_edge_m);

/// The mesh of one ping: fine where views look and as coarse as it can be elsewhere. A function of the hierarchy and
/// the views; what was chosen before leaves nothing but memory.
class Cut {
 public:
  explicit Cut(const Hierarchy& hierarchy);

  /// For views of the hierarchy that this was made for.
  /// A path of a view of tolerance 0 meets what it would meet in the source, the same triangles: first every split
  /// whose box the view meets is undone, then, round by round, what has been moved and still stands in the view.
  void choose(const Hierarchy& hierarchy, std::span<const View> views);

  /// Their corners are vertices of the mesh.
  std::span<const Triangle> triangles() const { return triangles_; }
  /// Which of the source each of them is, or stands for.
  std::span<const std::uint32_t> sources() const { return sources_; }

 private:
  void undo(const Hierarchy& hierarchy, std::int32_t split);
  void look(const Hierarchy& hierarchy, std::span<const View> views);
  void gather(const Hierarchy& hierarchy);
  void find_moved(const Hierarchy& hierarchy);
  bool settle(const Hierarchy& hierarchy, std::span<const View> views);
  bool ask_back(const Hierarchy& hierarchy, std::uint32_t vertex, double tolerance_m);
  std::uint32_t shown(std::uint32_t vertex);

  std::vector<std::int32_t> roots_;   // splits without a parent
  std::vector<std::uint8_t> undone_;  // by split
  std::vector<std::int32_t> all_undone_;
  std::vector<std::uint32_t> becomes_;  // by vertex: another one, or itself where that is undone
  std::vector<std::int32_t> pending_;
  std::size_t gathered_ = 0;                // of all_undone_: in sources_
  std::vector<std::uint32_t> shown_;        // by vertex, as far as it is known
  std::vector<std::uint32_t> shown_known_;  // vertices of which it is
  std::vector<std::uint32_t> way_;
  std::vector<std::uint32_t> sources_;
  std::vector<Triangle> triangles_;
  std::vector<std::size_t> moved_;              // places in triangles_
  std::vector<std::uint8_t> stands_;            // by these and by view
  std::vector<std::uint32_t> settled_sources_;  // in order: of triangles that need not be looked at again ...
  std::vector<Triangle> settled_;               // ... as long as they are these
};

}  // namespace ensonify::progressive
