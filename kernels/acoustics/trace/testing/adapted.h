#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "kernels/acoustics/trace/scene.h"
#include "kernels/acoustics/trace/views.h"
#include "kernels/base/random/stream.h"
#include "kernels/water/refraction/thermocline.h"

/// For tests of level of detail: rays of one fan, traced in a scene that is adapted to it and in one at full detail.
namespace ensonify::trace::adapted {

inline const TransmitVolume kFan = mills_cross_volume(50.0, 50.0, 1.13);

inline std::array<lod::View, 2> views_at(const frames::HeadPose& head, float range_m, const lod::Water& water = {}) {
  return views_of(kFan, head, static_cast<double>(range_m), water, 2);
}

enum class Lobes { kMain, kSide, kAll };

/// At random over the volume or a part of it; fewer than `count` of side lobes alone.
inline Rays rays_of(int ping, std::size_t count, Lobes lobes) {
  const random::Stream draws(11, "rays");
  const Span &u = kFan.sine, &phi = kFan.angle_rad;
  const bool main = lobes == Lobes::kMain;
  Rays rays;
  for (std::size_t i = 0; i < count; ++i) {
    const auto k = static_cast<std::uint64_t>(ping);
    const double sine = std::lerp(main ? u.main_low : u.low, main ? u.main_high : u.high, draws.uniform(k, i, 0));
    if (lobes == Lobes::kSide && u.main_low <= sine && sine <= u.main_high) continue;
    const double angle = std::lerp(phi.low, phi.high, draws.uniform(k, i, 1)), beside = std::sqrt(1.0 - sine * sine);
    rays.push_back({frames::Vec3(sine, beside * std::sin(angle), beside * std::cos(angle)).cast<float>(), 1.0F});
  }
  return rays;
}

/// Number of hits that are not equal to the bit.
inline std::size_t differences(const Hits& a, const Hits& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool same = a[i].range_m == b[i].range_m && a[i].position_enu_m == b[i].position_enu_m &&
                      a[i].normal_enu == b[i].normal_enu && a[i].travel_time_s == b[i].travel_time_s &&
                      a[i].tube_m2 == b[i].tube_m2 && a[i].sin_grazing == b[i].sin_grazing &&
                      a[i].facet_m == b[i].facet_m && a[i].contributor == b[i].contributor;
    count += same ? 0U : 1U;
  }
  return count;
}

/// Depths between which water bends rays: of the head, and of the deepest ground.
struct Depths {
  double head_m, bottom_m;
};

/// Differences of a ping between both scenes: rays of the main lobe, straight and in a summer's water, and rays in all
/// directions. `hits` are the straight main lobe's in it.
struct PingDifferences {
  std::size_t main_lobe = 0, all_round = 0;
  Hits hits;
};

inline PingDifferences ping_differences(const Scene& full, const Scene& scene, const frames::HeadPose& head,
                                        float range_m, const Rays& main_lobe, const Rays& all_round,
                                        const Depths& depths) {
  PingDifferences found;
  Hits all, some;
  const Mesh whole = full.adapted();
  Mesh mesh = scene.adapted(views_at(head, range_m));
  whole.trace(head, main_lobe, range_m, all);
  mesh.trace(head, main_lobe, range_m, found.hits);
  found.main_lobe += differences(all, found.hits);
  whole.trace(head, all_round, range_m, all);
  mesh.trace(head, all_round, range_m, some);
  found.all_round += differences(all, some);

  const auto summer = refraction::summer_thermocline();
  refraction::PathTable paths;
  mesh.tabulate(summer, head, depths.head_m, range_m, paths);
  mesh = scene.adapted(views_at(head, range_m, water_above(summer, depths.head_m, depths.bottom_m)));
  whole.trace(head, main_lobe, range_m, all, paths);
  mesh.trace(head, main_lobe, range_m, some, paths);
  found.main_lobe += differences(all, some);
  return found;
}

}  // namespace ensonify::trace::adapted
