#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "kernels/mesh/lod/cover.h"
#include "kernels/mesh/lod/frustum.h"
#include "kernels/mesh/progressive/hierarchy.h"

namespace ensonify::progressive {

/// View of a mesh, and the tolerance of the surface there; 0: not at all.
struct View {
  lod::Frustum frustum;
  double tolerance_m = 0.0;
};

/// Mean length of the sides of its triangles; 0 without any.
double mean_edge_m(const TriangleMesh& mesh);

/// Views of tiles as views of a mesh beside them: nothing off at level 0; at level n, which sees every 2^n-th post,
/// 2^n tenths of the mesh's mean edge.
std::vector<View> views_of(std::span<const lod::View> views, double mean_edge_m);

/// The mesh of one ping: fine where views are and as coarse as it can be elsewhere. A function of the hierarchy and
/// the views; what was chosen before leaves nothing but memory.
class Cut {
 public:
  explicit Cut(const Hierarchy& hierarchy);

  /// For views of the hierarchy that this was made for.
  /// A path of a view of tolerance 0 hits what it would hit in the source, the same triangles: first every split
  /// whose box the view intersects is undone, then, round by round, what has been moved and still stands in the view.
  void choose(const Hierarchy& hierarchy, std::span<const View> views);

  /// Their corners are vertices of the mesh.
  std::span<const Triangle> triangles() const { return triangles_; }
  /// Which of the source each of them is, or stands for.
  std::span<const std::uint32_t> sources() const { return sources_; }

 private:
  struct PreparedView;  // a view, prepared
  /// A source triangle that is there, on what its corners have become.
  struct Standing {
    std::uint32_t source;
    Triangle corners;
  };
  void undo(const Hierarchy& hierarchy, std::int32_t split);
  void undo_in_view(const Hierarchy& hierarchy, std::span<const PreparedView> views);
  void gather(const Hierarchy& hierarchy);
  void forget_ways(const Hierarchy& hierarchy);
  Triangle corners_of(const Hierarchy& hierarchy, std::uint32_t source);
  void add(const Hierarchy& hierarchy, std::span<const std::uint32_t> sources);
  bool settle(const Hierarchy& hierarchy, std::span<const PreparedView> views);
  std::span<const std::int32_t> back_within(const Hierarchy& hierarchy, double tolerance_m);
  void put_in_order(const Hierarchy& hierarchy);
  std::uint32_t shown(std::uint32_t vertex);

  std::vector<std::int32_t> roots_;   // splits without a parent
  std::vector<std::uint8_t> undone_;  // by split
  std::vector<std::int32_t> all_undone_;
  std::vector<std::uint32_t> becomes_;  // by vertex: another one, or itself where that is undone
  std::vector<std::int32_t> to_judge_;
  std::vector<std::uint32_t> shown_;        // by vertex, as far as it is known
  std::vector<std::uint32_t> shown_known_;  // vertices of which it is
  std::vector<std::uint8_t> changes_;       // by vertex: whether others may no longer become it
  std::vector<std::uint32_t> way_;
  std::vector<Standing> standing_;
  std::size_t gathered_ = 0;                          // of all_undone_: their triangles stand
  std::vector<std::uint32_t> to_settle_;              // places in standing_: moved, and not yet examined as they are
  std::vector<std::uint8_t> stands_in_;               // a view: by view, then by these
  std::map<double, std::vector<std::int32_t>> back_;  // by tolerance, of the views in use
  std::vector<std::uint64_t> there_;                  // a bit for each source triangle
  std::vector<std::uint32_t> sources_;
  std::vector<Triangle> triangles_;
};

}  // namespace ensonify::progressive
