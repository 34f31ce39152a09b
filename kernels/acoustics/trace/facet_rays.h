#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kernels/acoustics/trace/ray.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"
#include "kernels/base/random/stream.h"
#include "kernels/water/refraction/path_table.h"

namespace ensonify::trace {

/// From where rays go to facets, and how far. `refracted` is what Scene::tabulate made for this head; null: paths are
/// straight.
struct FacetView {
  const frames::HeadPose& head;
  double max_range_m;
  const refraction::PathTable* refracted;
};

/// Demand of a transmission for rays to facets. Vectors are launch directions times distances, head frame.
struct FacetDemand {
  /// Number of rays that a facet with these corners needs; below 1 it has one with that probability.
  std::function<double(const std::array<frames::Vec3, 3>& corners_head_m)> rays;
  /// Whether a ray goes there at all.
  std::function<bool(const frames::Vec3& direction_head_m)> holds;
  /// Whether a ray may go to a ball; where it may not, objects cost nothing.
  std::function<bool(const frames::Vec3& middle_head_m, double radius_m)> touches;
  std::size_t most;  // rays: all facets give way by the same share; twice as many at the utmost, for they are whole
};

/// Targets of rays to facets, and the cells whose facets have such rays.
struct FacetTargets {
  struct Facet {
    std::uint32_t tile;   // its number
    std::uint32_t facet;  // 2 (row x columns + column), and 1 for the north-eastern half of the cell
    float area_m2;        // its share of it
  };
  struct Tile {  // that has such cells
    std::uint32_t number;
    const terrain::Tile* tile;
    std::size_t first_cell;  // of those below
  };
  std::vector<Facet> facets;  // by ray
  std::vector<Tile> tiles;    // by number
  std::vector<bool> cells;    // whether taken, tile by tile, row by row
};

/// Rays to facets, yet without solid angles, and scratch of their choice.
struct FacetMemory {
  struct Facet {
    FacetTargets::Facet target;
    std::array<frames::Vec3, 3> corners_enu_m;
    std::size_t object;
    double wanted;
  };
  Rays rays;
  std::vector<Facet> facets;
};

/// Rays to the facets of small objects.
///
/// Rays that are spread over directions miss what is small or seen edge-on. So each facet has rays of its own, to
/// places that are spread over it and stay with it. Such a ray counts if its facet is the first that it hits, and
/// stands for its share of the facet's area: it carries the solid angle area sin(grazing) / tube, as it then finds
/// them. Rays that are spread over directions and hit a facet that has its own do not count: nothing is counted twice,
/// and what lies behind stays hidden. Both are unbiased, so their sum is.
///
/// In refracting water the launch direction is that of the eigenray, exact at the corners of the object's box (distance
/// and depth) and between them by straight lines of its difference to the straight direction. An object that no path
/// reaches, or several with directions apart, is left to the other rays; so is one that is wider than its distance.
///
/// Chooses the rays to these objects, memory.rays.
void aim_at_facets(const random::Stream& stream, std::span<const Object> objects, const FacetView& view,
                   const FacetDemand& demand, FacetMemory& memory, FacetTargets& targets);

/// When all rays have been traced, those to facets as the last: makes misses of hits that do not count, and gives the
/// facets' rays what solid angle they carry. Throws std::invalid_argument unless there is one hit per ray.
void settle(const FacetTargets& targets, Rays& rays, Hits& hits);

}  // namespace ensonify::trace
