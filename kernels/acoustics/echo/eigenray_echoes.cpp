#include "kernels/acoustics/echo/eigenray_echoes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "kernels/water/refraction/eigenray.h"

namespace ensonify::echo {
namespace {

using frames::Vec3;

constexpr std::size_t kPerTask = 256;
constexpr int kMostSteps = 8;       // each takes the error times v / c
constexpr double kStep_s = 1e-12;   // at which the iteration ends
constexpr double kSamePath = 1e-4;  // of the time: another path differs by more
constexpr double kNearest_m = 1e-3;

/// One way, from a head to a scatterer.
struct Way {
  double time_s, length_m, tube_m2;
  Vec3 direction_enu;  // of launch at the head, unit
};

std::optional<Way> way(const refraction::SoundSpeedProfile& profile, const Vec3& head_enu_m, const Vec3& place_enu_m) {
  const Vec3 off = place_enu_m - head_enu_m;
  const double across_m = off.head<2>().norm();
  const auto path = refraction::eigenray(profile, -head_enu_m.z(), across_m, -place_enu_m.z());
  if (!path) return std::nullopt;
  const Eigen::Vector2d outwards =
      across_m > 0.0 ? Eigen::Vector2d(off.head<2>() / across_m) : Eigen::Vector2d::UnitX();
  const double depression_rad = path->launch_depression_rad;
  Way way{path->end.travel_time_s, path->end.path_length_m, path->end.tube_m2, {}};
  way.direction_enu << std::cos(depression_rad) * outwards, -std::sin(depression_rad);
  return way;
}

std::optional<Arrival> eigenray_echo(const Carrier& carrier, const refraction::SoundSpeedProfile& profile,
                                     const Vec3& source_enu_m, const Scatterer& scatterer, const Receivers& receivers) {
  const Vec3& place = scatterer.position_enu_m;
  const double straight_s = (place - source_enu_m).norm() * static_cast<double>(scatterer.slowness_spm);
  const auto out = way(profile, source_enu_m, place);
  if (!out || std::abs(out->time_s - straight_s) > kSamePath * straight_s) return std::nullopt;
  Arrival arrival;
  arrival.time_s = 2.0 * out->time_s;
  std::optional<Way> back;
  Receivers::At receiver;
  for (int step = 0; step < kMostSteps; ++step) {
    receiver = receivers.at(arrival.time_s);
    back = way(profile, receiver.position_enu_m, place);
    if (!back) return std::nullopt;
    const double before_s = arrival.time_s;
    arrival.time_s = out->time_s + back->time_s;
    if (std::abs(arrival.time_s - before_s) < kStep_s) break;
  }
  const double loss = power_ratio(-carrier.absorption_dbpm * (out->length_m + back->length_m));
  const double mean_square =
      static_cast<double>(scatterer.scattered_upa2m2) * loss / std::max(back->tube_m2, kNearest_m * kNearest_m);
  arrival.pressure_upa = scatterer.share * echo_pressure(carrier, mean_square, arrival.time_s, scatterer.response);
  arrival.contributor = scatterer.contributor;
  arrival.direction_head = (receiver.head_from_enu * back->direction_enu.cast<float>()).normalized();
  return arrival;
}

}  // namespace

void take_eigenrays(const Carrier& carrier, const refraction::SoundSpeedProfile& profile, const Vec3& source_enu_m,
                    const Scatterers& scatterers, const Receivers& receivers, std::size_t first, Arrivals& arrivals) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, scatterers.size(), kPerTask),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          if (const auto exact = eigenray_echo(carrier, profile, source_enu_m, scatterers[i], receivers))
            arrivals.set(first + i, *exact);
        }
      },
      tbb::simple_partitioner());
}

void add_eigenray_echoes(const Carrier& carrier, const refraction::SoundSpeedProfile& profile, const Vec3& source_enu_m,
                         const Scatterers& scatterers, const Receivers& receivers, Arrivals& arrivals) {
  const std::size_t first = arrivals.size();
  add_direct_echoes(carrier, source_enu_m, scatterers, receivers, arrivals);
  take_eigenrays(carrier, profile, source_enu_m, scatterers, receivers, first, arrivals);
}

}  // namespace ensonify::echo
