#include "kernels/mesh/progressive/cut.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
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

/// Whether a view can intersect a triangle: by spheres around quarters of quarters of it, so that a long one beside a
/// narrow view need not come back.
bool stands_in(const lod::PreparedFrustum& frustum, const std::array<frames::Vec3, 3>& corner, int quarters) {
  Eigen::AlignedBox3d box;
  for (const frames::Vec3& place : corner) box.extend(place);
  if (!frustum.intersects({box.center(), 0.5 * box.diagonal().norm() + kSlack_m})) return false;
  const auto& [a, b, c] = corner;
  if (quarters == 0 || frustum.intersects({(a + b + c) / 3.0, kSlack_m})) return true;
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
  std::vector<View> views_of_level;
  for (const lod::View& view : views)
    views_of_level.push_back({view.frustum, view.level == 0 ? 0.0 : std::ldexp(kTolerance * mean_edge_m, view.level)});
  return views_of_level;
}

struct Cut::PreparedView {
  lod::PreparedFrustum frustum;
  double tolerance_m;
  std::span<const std::int32_t> back;
};

Cut::Cut(const Hierarchy& hierarchy)
    : undone_(hierarchy.splits.size(), 0),
      becomes_(hierarchy.mesh.vertex_m.size()),
      shown_(hierarchy.mesh.vertex_m.size(), kUnknown),
      changes_(hierarchy.mesh.vertex_m.size(), 0),
      there_(hierarchy.mesh.triangle.size() / 64 + 1, 0) {
  std::iota(becomes_.begin(), becomes_.end(), 0U);
  for (const Split& split : hierarchy.splits) becomes_[split.removed] = split.kept;
  for (std::size_t s = 0; s < hierarchy.splits.size(); ++s) {
    if (hierarchy.splits[s].parent == kNone) roots_.push_back(static_cast<std::int32_t>(s));
  }
}

/// By vertex: the split that brings it near enough to its place.
std::span<const std::int32_t> Cut::back_within(const Hierarchy& hierarchy, double tolerance_m) {
  const auto [known, is_new] = back_.try_emplace(tolerance_m);
  if (is_new) {
    std::vector<std::int32_t> near;  // by split: itself, or the one above it
    near.reserve(hierarchy.splits.size());
    for (const Split& split : hierarchy.splits) {
      const bool far = too_far(split, tolerance_m);
      near.push_back(far                     ? static_cast<std::int32_t>(near.size())
                     : split.parent == kNone ? kNone
                                             : near[static_cast<std::size_t>(split.parent)]);
    }
    for (const std::int32_t split : hierarchy.split_of)
      known->second.push_back(split == kNone ? kNone : near[static_cast<std::size_t>(split)]);
  }
  return known->second;
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

/// Down the tree, as far as views intersect what lies below.
void Cut::undo_in_view(const Hierarchy& hierarchy, std::span<const PreparedView> views) {
  for (const std::int32_t s : all_undone_) {
    undone_[static_cast<std::size_t>(s)] = 0;
    becomes_[at(hierarchy, s).removed] = at(hierarchy, s).kept;
  }
  all_undone_.clear();
  to_judge_ = roots_;
  for (std::size_t i = 0; i < to_judge_.size(); ++i) {
    const std::int32_t s = to_judge_[i];
    const Split& split = at(hierarchy, s);
    const lod::Sphere sphere = sphere_around(split.box_m, hierarchy.mesh.origin_enu_m);
    if (std::none_of(views.begin(), views.end(), [&](const PreparedView& view) {
          return too_far(split, view.tolerance_m) && view.frustum.intersects(sphere);
        }))
      continue;
    undo(hierarchy, s);
    for (const std::int32_t child : split.child) {
      if (child == kNone) continue;
      to_judge_.push_back(child);
      __builtin_prefetch(&at(hierarchy, child));  // they lie anywhere: here, until their turn comes
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

Triangle Cut::corners_of(const Hierarchy& hierarchy, std::uint32_t source) {
  const auto& [a, b, c] = hierarchy.mesh.triangle[source];
  return {shown(a), shown(b), shown(c)};
}

void Cut::add(const Hierarchy& hierarchy, std::span<const std::uint32_t> sources) {
  for (const std::uint32_t source : sources) __builtin_prefetch(&hierarchy.mesh.triangle[source]);
  for (const std::uint32_t source : sources) {
    standing_.push_back({source, corners_of(hierarchy, source)});
    if (standing_.back().corners != hierarchy.mesh.triangle[source])
      to_settle_.push_back(static_cast<std::uint32_t>(standing_.size() - 1));
  }
}

/// Vertices that have come back since the last round may have been passed by others. What these had become is forgotten
/// and found anew for the triangles that have it.
void Cut::forget_ways(const Hierarchy& hierarchy) {
  std::vector<std::uint32_t> ends;
  for (std::size_t i = gathered_; i < all_undone_.size(); ++i) {
    const std::uint32_t end = shown_[at(hierarchy, all_undone_[i]).removed];
    if (end == kUnknown || changes_[end] != 0) continue;
    changes_[end] = 1;
    ends.push_back(end);
  }
  std::erase_if(shown_known_, [&](std::uint32_t vertex) {
    const bool changes = changes_[shown_[vertex]] != 0;
    if (changes) shown_[vertex] = kUnknown;
    return changes;
  });
  for (std::size_t i = 0; i < standing_.size(); ++i) {
    auto& [source, corners] = standing_[i];
    if (std::ranges::none_of(corners, [&](std::uint32_t corner) { return changes_[corner] != 0; })) continue;
    corners = corners_of(hierarchy, source);
    if (corners != hierarchy.mesh.triangle[source]) to_settle_.push_back(static_cast<std::uint32_t>(i));
  }
  for (const std::uint32_t end : ends) changes_[end] = 0;
}

/// The triangles of what is undone now. Those that were born stay; their corners may not.
void Cut::gather(const Hierarchy& hierarchy) {
  forget_ways(hierarchy);
  sources_.clear();
  for (; gathered_ < all_undone_.size(); ++gathered_) {
    const Split& split = at(hierarchy, all_undone_[gathered_]);
    const auto first = hierarchy.born.begin() + split.first_born;
    sources_.insert(sources_.end(), first, first + split.born);
  }
  add(hierarchy, sources_);
}

/// A triangle that was moved may stand in a view though nothing of what it stands for does: its corners are asked back.
/// False if none was away.
bool Cut::settle(const Hierarchy& hierarchy, std::span<const PreparedView> views) {
  const std::size_t count = to_settle_.size();
  stands_in_.assign(views.size() * count, 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kPerTask), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      std::array<frames::Vec3, 3> corners;
      for (std::size_t c = 0; c < 3; ++c) {
        const Eigen::Vector3f& place = hierarchy.mesh.vertex_m[standing_[to_settle_[i]].corners[c]];
        corners[c] = hierarchy.mesh.origin_enu_m + place.cast<double>();
      }
      for (std::size_t v = 0; v < views.size(); ++v)
        stands_in_[v * count + i] = stands_in(views[v].frustum, corners, kQuarters) ? 1 : 0;
    }
  });
  bool changed = false;
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (std::size_t i = 0; i < count; ++i) {
      if (stands_in_[v * count + i] == 0) continue;
      for (const std::uint32_t corner : hierarchy.mesh.triangle[standing_[to_settle_[i]].source]) {
        const std::int32_t back = views[v].back[corner];
        if (back == kNone || undone_[static_cast<std::size_t>(back)] != 0) continue;
        undo(hierarchy, back);
        changed = true;
      }
    }
  }
  to_settle_.clear();
  return changed;
}

/// Of the source.
void Cut::put_in_order(const Hierarchy& hierarchy) {
  sources_.clear();
  triangles_.clear();
  for (const Standing& one : standing_) there_[one.source / 64] |= std::uint64_t{1} << one.source % 64;
  for (std::size_t word = 0; word < there_.size(); ++word) {
    for (std::uint64_t& bits = there_[word]; bits != 0; bits &= bits - 1) {
      sources_.push_back(static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(std::countr_zero(bits)));
      triangles_.push_back(corners_of(hierarchy, sources_.back()));
    }
  }
}

void Cut::choose(const Hierarchy& hierarchy, std::span<const View> wanted) {
  std::erase_if(back_, [&](const auto& known) {
    return std::ranges::none_of(wanted, [&](const View& view) { return view.tolerance_m == known.first; });
  });
  std::vector<PreparedView> views;
  for (const View& view : wanted) {
    views.push_back({lod::PreparedFrustum(view.frustum), view.tolerance_m, back_within(hierarchy, view.tolerance_m)});
  }
  undo_in_view(hierarchy, views);
  for (const std::uint32_t vertex : shown_known_) shown_[vertex] = kUnknown;
  shown_known_.clear();
  standing_.clear();
  to_settle_.clear();
  gathered_ = 0;
  add(hierarchy, hierarchy.coarsest);
  for (bool changed = true; changed; changed = settle(hierarchy, views)) gather(hierarchy);
  put_in_order(hierarchy);
}

}  // namespace ensonify::progressive
