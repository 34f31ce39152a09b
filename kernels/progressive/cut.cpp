#include "kernels/progressive/cut.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ensonify::progressive {
namespace {

const Split& at(const Hierarchy& hierarchy, std::int32_t split) {
  return hierarchy.splits[static_cast<std::size_t>(split)];
}

bool too_far(const Split& split, double tolerance_m) {
  return tolerance_m <= 0.0 || static_cast<double>(split.deviation_m) > tolerance_m;
}

/// Whether a view can meet a triangle: by spheres around quarters of quarters of it, so that a long one beside a narrow
/// view need not come back.
bool stands_in(const lod::Frustum& frustum, const std::array<frames::Vec3, 3>& corner, int quarters) {
  Eigen::AlignedBox3d box;
  for (const frames::Vec3& place : corner) box.extend(place);
  if (!lod::meets(frustum, {box.center(), 0.5 * box.diagonal().norm() + kSlack_m})) return false;
  if (quarters == 0) return true;
  const auto& [a, b, c] = corner;
  const frames::Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  return stands_in(frustum, {a, ab, ca}, quarters - 1) || stands_in(frustum, {ab, b, bc}, quarters - 1) ||
         stands_in(frustum, {ca, bc, c}, quarters - 1) || stands_in(frustum, {ab, bc, ca}, quarters - 1);
}

constexpr int kQuarters = 4;
constexpr std::uint32_t kUnknown = 0xFFFFFFFFU;
constexpr std::size_t kPerTask = 128;

}  // namespace

double mean_edge_m(const TriangleMesh& mesh) {
  double sum_m = 0.0;
  for (const auto& [a, b, c] : mesh.triangle) {
    const frames::Vec3 ab = (mesh.vertex_m[b] - mesh.vertex_m[a]).cast<double>();
    const frames::Vec3 ac = (mesh.vertex_m[c] - mesh.vertex_m[a]).cast<double>();
    sum_m += ab.norm() + ac.norm() + (ac - ab).norm();
  }
  return sum_m / (3.0 * std::max(1.0, static_cast<double>(mesh.triangle.size())));
}

std::vector<View> views_of(std::span<const lod::View> views, double mean_edge_m) {
  constexpr double kTolerance = 0.1;  // mean edges, times 2^level
  std::vector<View> looks;
  for (const lod::View& view : views)
    looks.push_back({view.frustum, view.level == 0 ? 0.0 : std::ldexp(kTolerance * mean_edge_m, view.level)});
  return looks;
}

Cut::Cut(const Hierarchy& hierarchy)
    : undone_(hierarchy.splits.size(), 0),
      becomes_(hierarchy.mesh.vertex_m.size()),
      shown_(hierarchy.mesh.vertex_m.size(), kUnknown) {
  std::iota(becomes_.begin(), becomes_.end(), 0U);
  for (const Split& split : hierarchy.splits) becomes_[split.removed] = split.kept;
  for (std::size_t s = 0; s < hierarchy.splits.size(); ++s) {
    if (hierarchy.splits[s].parent == kNone) roots_.push_back(static_cast<std::int32_t>(s));
  }
}

/// With all that must be undone before it.
void Cut::undo(const Hierarchy& hierarchy, std::int32_t split) {
  for (; split != kNone && undone_[static_cast<std::size_t>(split)] == 0; split = at(hierarchy, split).parent) {
    undone_[static_cast<std::size_t>(split)] = 1;
    const std::uint32_t back = at(hierarchy, split).removed;
    becomes_[back] = back;
    all_undone_.push_back(split);
  }
}

/// Down the tree, as far as views meet what lies below.
void Cut::look(const Hierarchy& hierarchy, std::span<const View> views) {
  for (const std::int32_t s : all_undone_) {
    undone_[static_cast<std::size_t>(s)] = 0;
    becomes_[at(hierarchy, s).removed] = at(hierarchy, s).kept;
  }
  all_undone_.clear();
  pending_ = roots_;
  while (!pending_.empty()) {
    const std::int32_t s = pending_.back();
    pending_.pop_back();
    const Split& split = at(hierarchy, s);
    const lod::Sphere sphere = sphere_around(split.box_m, hierarchy.mesh.origin_enu_m);
    if (std::none_of(views.begin(), views.end(), [&](const View& view) {
          return too_far(split, view.tolerance_m) && lod::meets(view.frustum, sphere);
        }))
      continue;
    undo(hierarchy, s);
    for (const std::int32_t child : split.child) {
      if (child != kNone) pending_.push_back(child);
    }
  }
}

/// What a vertex has become, remembered for all that it passes on its way: neighbours share most of theirs.
std::uint32_t Cut::shown(std::uint32_t vertex) {
  way_.clear();
  while (shown_[vertex] == kUnknown) {
    way_.push_back(vertex);
    if (becomes_[vertex] == vertex) break;
    vertex = becomes_[vertex];
  }
  const std::uint32_t end = shown_[vertex] == kUnknown ? vertex : shown_[vertex];
  for (const std::uint32_t passed : way_) shown_[passed] = end;
  shown_known_.insert(shown_known_.end(), way_.begin(), way_.end());
  return end;
}

/// The triangles of what is undone now. Those that were born stay; their corners may not.
void Cut::gather(const Hierarchy& hierarchy) {
  const auto known = static_cast<std::ptrdiff_t>(sources_.size());
  for (; gathered_ < all_undone_.size(); ++gathered_) {
    const Split& split = at(hierarchy, all_undone_[gathered_]);
    const auto first = hierarchy.born.begin() + split.first_born;
    sources_.insert(sources_.end(), first, first + split.born);
  }
  std::sort(sources_.begin() + known, sources_.end());
  std::inplace_merge(sources_.begin(), sources_.begin() + known, sources_.end());
  for (const std::uint32_t vertex : shown_known_) shown_[vertex] = kUnknown;
  shown_known_.clear();
  triangles_.clear();
  for (const std::uint32_t source : sources_) {
    const auto& [a, b, c] = hierarchy.mesh.triangle[source];
    triangles_.push_back({shown(a), shown(b), shown(c)});
  }
}

/// Brings a vertex near enough to its place. False if it was.
bool Cut::ask_back(const Hierarchy& hierarchy, std::uint32_t vertex, double tolerance_m) {
  std::int32_t split = hierarchy.split_of[vertex];
  while (split != kNone && !too_far(at(hierarchy, split), tolerance_m)) split = at(hierarchy, split).parent;
  if (split == kNone || undone_[static_cast<std::size_t>(split)] != 0) return false;
  undo(hierarchy, split);
  return true;
}

/// Triangles that were moved, but for those that are as they were in the round before: they have been asked back, as
/// far as they may be.
void Cut::find_moved(const Hierarchy& hierarchy) {
  moved_.clear();
  std::size_t before = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (triangles_[i] == hierarchy.mesh.triangle[sources_[i]]) continue;
    while (before < settled_.size() && settled_sources_[before] < sources_[i]) ++before;
    const bool known = before < settled_.size() && settled_sources_[before] == sources_[i];
    if (!known || settled_[before] != triangles_[i]) moved_.push_back(i);
  }
}

/// A triangle that was moved may stand in a view though nothing of what it stands for does. False if none does.
bool Cut::settle(const Hierarchy& hierarchy, std::span<const View> views) {
  find_moved(hierarchy);
  stands_.assign(moved_.size() * views.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, moved_.size(), kPerTask), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      std::array<frames::Vec3, 3> corners;
      for (std::size_t c = 0; c < 3; ++c) {
        const Eigen::Vector3f& place = hierarchy.mesh.vertex_m[triangles_[moved_[i]][c]];
        corners[c] = hierarchy.mesh.origin_enu_m + place.cast<double>();
      }
      for (std::size_t v = 0; v < views.size(); ++v)
        stands_[i * views.size() + v] = stands_in(views[v].frustum, corners, kQuarters) ? 1 : 0;
    }
  });
  bool changed = false;
  for (std::size_t i = 0; i < stands_.size(); ++i) {
    if (stands_[i] == 0) continue;
    for (const std::uint32_t corner : hierarchy.mesh.triangle[sources_[moved_[i / views.size()]]])
      changed = ask_back(hierarchy, corner, views[i % views.size()].tolerance_m) || changed;
  }
  settled_sources_ = sources_;
  settled_ = triangles_;
  return changed;
}

void Cut::choose(const Hierarchy& hierarchy, std::span<const View> views) {
  settled_sources_.clear();
  settled_.clear();
  look(hierarchy, views);
  sources_ = hierarchy.coarsest;
  std::sort(sources_.begin(), sources_.end());
  gathered_ = 0;
  gather(hierarchy);
  while (settle(hierarchy, views)) gather(hierarchy);
}

}  // namespace ensonify::progressive
