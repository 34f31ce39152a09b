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
class FacetRays {
 public:
  /// From where, and how far. `bent` is what Scene::tabulate made for this head; null: paths are straight.
  struct View {
    const frames::HeadPose& head;
    double max_range_m;
    const refraction::PathTable* refracted;
  };
  /// Demand of a transmission. Vectors are launch directions times distances, head frame.
  struct Demand {
    /// Number of rays that a facet with these corners needs; below 1 it has one with that probability.
    std::function<double(const std::array<frames::Vec3, 3>& corners_head_m)> rays;
    /// Whether a ray goes there at all.
    std::function<bool(const frames::Vec3& direction_head_m)> holds;
    /// Whether a ray may go to a ball; where it may not, objects cost nothing.
    std::function<bool(const frames::Vec3& middle_head_m, double radius_m)> touches;
    std::size_t most;  // rays: all facets give way by the same share; twice as many at the utmost, for they are whole
  };

  explicit FacetRays(const random::Stream& stream) : stream_(stream) {}

  /// Chooses the rays to these objects; their number.
  std::size_t aim(std::span<const Object> objects, const View& view, const Demand& demand);
  /// Adds them to others, yet without solid angles.
  void append(std::vector<Ray>& rays);

  /// Settlement of the hits once all rays are traced: makes misses of those that do not count, and
  /// gives the facets' rays what solid angle they carry.
  void settle(std::span<Ray> rays, std::span<Hit> hits) const;

 private:
  struct Target {
    std::uint32_t tile;   // its number
    std::uint32_t facet;  // 2 (row x columns + column), and 1 for the north-eastern half of the cell
    float area_m2;        // its share of it
  };
  struct Taken {  // a tile that has cells whose facets have rays of their own
    std::uint32_t number;
    const terrain::Tile* tile;
    std::size_t first_cell;  // of those below
  };
  struct Facet {
    Target target;
    std::array<frames::Vec3, 3> corners_enu_m;
    std::size_t object;
    double wanted;
  };
  void gather(std::span<const Object> objects, const View& view, const Demand& demand);
  void take(const Object& object);
  const Taken* tile_of(const Hit& hit) const;

  random::Stream stream_;
  std::vector<Facet> facets_;
  std::vector<Ray> rays_;
  std::vector<Target> targets_;  // of the rays
  std::size_t first_ = 0;        // of the rays among all
  std::vector<Taken> taken_;     // by number
  std::vector<bool> cells_;      // whether taken, tile by tile, row by row
};

}  // namespace ensonify::trace
