// What the rays of a distribution reach: facets, resolution cells, the same places again, shadows.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "kernels/acoustics/trace/testing/boulders.h"

using namespace ensonify::trace;
using namespace ensonify::trace::sounding;
using namespace ensonify::terrain;
using ensonify::frames::HeadPose;

/// Facets that 16 draws hit at least 4 times in the main lobe, and those of them that one draw misses, of four seabeds.
struct Facets {
  int found = 0, unhit = 0;
};
static Facets facets(double smooth_below_m, double quality) {
  constexpr double kSpacing_m = 0.25;
  constexpr int kCells = 400;
  Facets facets;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Scene scene = strewn_with_boulders(seed, kSpacing_m, kCells, smooth_below_m);
    const auto count = [&](std::uint64_t draw, bool in_main_lobe, std::vector<int>& hits_of_facet) {
      const Sounding s = trace_ping(scene, {quality, 0.075}, draw);
      for (std::size_t k = 0; k < s.hits.size(); ++k) {
        const Ray& ray = s.rays[k];
        const bool main = std::abs(ray.direction_head.x()) < kNull && std::abs(across_rad(ray)) < kSwath_rad;
        if (!s.hits[k].hit() || (in_main_lobe && !main)) continue;
        const Vec2 at = s.hits[k].position_enu_m.head<2>() / kSpacing_m + Vec2(0.5 * kCells, 0.5 * kCells);
        const Vec2 cell = at.array().floor(), inside = at - cell;
        const bool upper = inside.x() + inside.y() > 1;  // Embree cuts from north-west to south-east
        ++hits_of_facet[static_cast<std::size_t>(2 * (cell.y() * kCells + cell.x()) + upper)];
      }
    };
    std::vector<int> once(2 * kCells * kCells), sixteen(2 * kCells * kCells);
    count(0, false, once);
    for (std::uint64_t draw = 1; draw <= 16; ++draw) count(draw, true, sixteen);
    for (std::size_t f = 0; f < once.size(); ++f) {
      facets.found += sixteen[f] >= 4;
      facets.unhit += sixteen[f] >= 4 && once[f] == 0;
    }
  }
  return facets;
}

TEST_CASE("of the main lobe facets that 16 times the rays hit, at most 0.1 % are unhit", "[long]") {
  // Shadows, silhouettes and facets seen edge-on. Four seabeds have 15,000 facets in the main lobe, so the limit is 15
  // of them. At normal quality where relief is smooth below four posts; where it is rough down to its posts, with three
  // times the rays, for what is seen nearly edge-on is missed by chance, as exp(-rays).
  const auto check = [](double smooth_below_m, double quality, double allowed = 1e-3) {
    const Facets of = facets(smooth_below_m, quality);
    CAPTURE(of.found, of.unhit);
    CHECK(of.found > 10'000);
    CHECK(of.unhit <= allowed * of.found);
  };
  check(kFourPosts_m, RaySettings::kNormal);
  check(kRough_m, 3.0);
  check(kFourPosts_m, RaySettings::kPreview, 0.04);  // a preview leaves 3.0 and 3.6 %
  check(kRough_m, RaySettings::kPreview, 0.04);
}

/// Rays in each resolution cell (range x beam of 1 degree) of a head over a plane: fewest, and mean.
struct Contributions {
  int fewest = 1 << 30;
  double mean = 0.0;
};
static Contributions contributions(const Sounding& s, double resolution_m, int beams) {
  constexpr double kTenthPower = 0.738;  // sinc^2 is -10 dB at 0.738 lambda / L
  Contributions c;
  int cells = 0;
  for (int b = 0; b < beams; ++b) {
    const double axis = kSwath_rad * (2.0 * b / (beams - 1) - 1.0), half = std::asin(kTenthPower * kNull);
    const double low = std::max(0.0, std::abs(axis) - half), high = std::abs(axis) + half;
    // Whole range cells within the beam; near nadir a beam is within one range cell.
    const double first = kDepth_m / std::cos(low), last = kDepth_m / std::cos(high);
    const int ranges = std::max(1, static_cast<int>((last - first) / resolution_m));
    std::vector<int> count(static_cast<std::size_t>(ranges));
    for (std::size_t k = 0; k < s.hits.size(); ++k) {
      if (!s.hits[k].hit() || std::abs(s.rays[k].direction_head.x()) > kTenthPower * kNull) continue;
      if (std::abs(across_rad(s.rays[k]) - axis) > half) continue;
      const int range = static_cast<int>((s.hits[k].range_m - first) / resolution_m);
      if (range >= 0 && range < ranges) ++count[static_cast<std::size_t>(range)];
    }
    for (const int n : count) {
      c.fewest = std::min(c.fewest, n);
      c.mean += n;
      ++cells;
    }
  }
  c.mean /= cells;
  return c;
}

TEST_CASE("every resolution cell within -10 dB gets at least 10 contributions") {
  const Scene scene = scene_of(flat);
  for (const double resolution_m : {0.02, 0.075, 0.3}) {
    const Sounding s = trace_ping(scene, {RaySettings::kNormal, resolution_m});
    const Contributions c = contributions(s, resolution_m, 131);
    CAPTURE(resolution_m, s.rays.size(), c.mean);
    CHECK(c.fewest >= 10);
  }
}

/// Of the main-lobe hits of `there`, the share that lies within 1 cm of a hit of `here`, on the horizontal.
static double found_again(const Sounding& here, const Sounding& there) {
  constexpr double kNear_m = 0.01;
  std::set<std::pair<long, long>> near;
  for (const Hit& hit : here.hits) {
    const Vec2 cell = hit.position_enu_m.head<2>() / kNear_m;
    for (const long x : {-1, 0, 1}) {
      for (const long y : {-1, 0, 1}) near.emplace(std::lround(cell.x()) + x, std::lround(cell.y()) + y);
    }
  }
  double again = 0, all = 0;
  for (std::size_t k = 0; k < there.hits.size(); ++k) {
    if (!there.hits[k].hit() || std::abs(there.rays[k].direction_head.x()) > kNull) continue;
    const Vec2 cell = there.hits[k].position_enu_m.head<2>() / kNear_m;
    ++all;
    again += double(near.count({std::lround(cell.x()), std::lround(cell.y())}));
  }
  return again / all;
}

TEST_CASE("a head that moved has rays to the places where they went before") {
  // 5 cm forward, heave, and a little of each rotation: a tenth of what is seen is new. Places that rays aim at lie on
  // planes a quarter of a metre apart and wander a little on relief. What another seed finds again is chance.
  const HeadPose moved{kHead.position_enu_m + Vec3(0.004, 0.05, 0.01),
                       kHead.enu_from_head * enu_from_body(ensonify::frames::Attitude{0.003, -0.002, 0.003}) *
                           enu_from_body(ensonify::frames::Attitude{}).conjugate()};
  for (const double quality : {RaySettings::kPreview, RaySettings::kNormal}) {
    const auto shares = [&](const Scene& scene) {
      return found_again(trace_ping(scene, {quality, 0.075}), trace_ping(scene, {quality, 0.075}, 1, moved));
    };
    const double level = shares(scene_of(flat)), relief = shares(strewn_with_boulders(1, 0.25, 400));
    const Scene plane = scene_of(flat);
    const double chance =
        found_again(trace_ping(plane, {quality, 0.075}), trace_ping(plane, {quality, 0.075}, 2, moved));
    CAPTURE(quality, level, relief, chance);
    CHECK(chance < 0.5);
    const bool preview = quality < 1.0;  // cells near nadir have too few rays to aim at places
    CHECK(level > (preview ? 0.6 : 0.85));
    CHECK(relief > (preview ? 0.5 : 0.65));
  }
}

TEST_CASE("what is behind a crest is in its shadow, to the crest's line of sight") {
  // A crest 5 m high along north at x = 10 m, 0.25 m wide at its foot. From 20 m above the seabed at x = 0.1 m its
  // shadow ends at 0.1 + 9.9 * 20 / 15 = 13.3 m.
  const Scene scene = scene_of([](double x, double) { return std::abs(x - 10) < 0.1 ? -15.0 : -20.0; });
  const Sounding s = trace_ping(scene, {RaySettings::kNormal, 0.075});
  double first_behind_m = 100;
  int on_crest = 0;
  for (const Hit& hit : s.hits) {
    const double x = hit.position_enu_m.x();
    on_crest += x > 9.75 && x < 10.001;
    if (x > 10.001) first_behind_m = std::min(first_behind_m, x);
  }
  const double cell_m = 0.075 / std::sin(std::atan2(13.2, 20.0));  // of the range resolution, on the seabed
  CHECK(first_behind_m > 13.3 - 1e-3);
  CHECK(first_behind_m < 13.3 + cell_m);
  // From crest to foot ranges go from 18.0 to 22.2 m: 56 range cells, 2.26 beams within the main lobe, 12 rays each.
  CHECK(on_crest > 56 * 2.26 * 12);
}
