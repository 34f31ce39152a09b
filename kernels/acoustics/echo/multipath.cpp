#include "kernels/acoustics/echo/multipath.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "kernels/acoustics/echo/run.h"
#include "kernels/acoustics/sea_surface.h"

namespace ensonify::echo {
namespace {

using frames::Vec3;

constexpr double kLeastReflection = 1e-5;
constexpr std::size_t kMostEach = 4;  // arrivals of a scatterer by way of the surface

/// As an amplitude.
double of_db(double db) { return std::pow(10.0, -0.05 * db); }

double wavenumber_radpm(const SurfaceMirror& surface, double frequency_hz) {
  return 2.0 * std::numbers::pi * frequency_hz / surface.sound_speed_mps;
}

/// The head's own sound from the surface overhead. It seems to come from the head's image, and left as if for it. The
/// carrier's phase is the path's; no draw.
Arrival surface_echo(const Carrier& carrier, const MultipathHead& head, const SurfaceMirror& surface,
                     const frames::HeadPose& pose, const Receivers& receivers) {
  const Vec3& from = pose.position_enu_m;
  const Vec3 image(from.x(), from.y(), 2.0 * surface.level_enu_m - from.z());
  const Receivers::At receiver = receivers.at((image - from).norm() / surface.sound_speed_mps);
  const Vec3 back = image - receiver.position_enu_m;
  const double path_m = std::max(back.norm(), 1e-3);
  const Eigen::Vector3f launch = (pose.enu_from_head.conjugate() * (image - from).normalized()).cast<float>();
  const double sent = power_ratio(head.source_level_db) * array::power(head.transmit, launch);
  const double reflected = surface_reflection(surface, carrier.frequency_hz, 1.0);
  const double mean_square =
      sent * reflected * reflected * power_ratio(-carrier.absorption_dbpm * path_m) / (path_m * path_m);
  Arrival arrival;
  arrival.time_s = path_m / surface.sound_speed_mps;
  arrival.pressure_upa = echo_pressure(carrier, mean_square, arrival.time_s, -1.0F);
  arrival.direction_head = receiver.head_from_enu * (back / path_m).cast<float>();
  return arrival;
}

/// Whether waves leave enough of the amplitude on the way to any scatterer: most where it is hit at the lowest angle.
bool reflects(const SurfaceMirror& surface, double frequency_hz, const frames::HeadPose& pose,
              const Scatterers& scatterers) {
  constexpr std::size_t kStep = 1024;  // of scatterers between looks
  const double roughness_rad = wavenumber_radpm(surface, frequency_hz) * surface.rms_height_m;
  const double left = std::log(of_db(surface.bounce_loss_db) / kLeastReflection);
  const Vec3& head = pose.position_enu_m;
  const double up_m = 2.0 * surface.level_enu_m - head.z();
  const auto& [x, y, z] = scatterers.position_enu_m;
  for (std::size_t first = 0; first < scatterers.size(); first += kStep) {
    int enough = 0;
    for (std::size_t i = first; i < std::min(first + kStep, scatterers.size()); ++i) {
      const double across = (x[i] - head.x()) * (x[i] - head.x()) + (y[i] - head.y()) * (y[i] - head.y());
      const double up = (up_m - z[i]) * (up_m - z[i]);
      enough += 2.0 * roughness_rad * roughness_rad * up <= left * (across + up) ? 1 : 0;
    }
    if (enough > 0) return true;
  }
  return false;
}

/// The ways by the surface of a ping, of the parts that are wanted.
class Ways {
 public:
  Ways(const Carrier& carrier, const Multipath& by, const frames::HeadPose& pose, const Scatterers& scatterers,
       const Receivers& receivers)
      : head_(by.head), head_from_enu_(pose.enu_from_head.conjugate().toRotationMatrix()) {
    const SurfaceMirror& surface = by.surface;
    if (!reflects(surface, carrier.frequency_hz, pose, scatterers)) return;
    // Mirrored at the surface; and of that once more at the scatterer's own level.
    const double level_m = surface.level_enu_m;
    const Run::Mirror once{.scale = -1.0,
                           .shift_m = 2.0 * level_m,
                           .amplitude = of_db(surface.bounce_loss_db),
                           .roughness_rad = wavenumber_radpm(surface, carrier.frequency_hz) * surface.rms_height_m,
                           .level_enu_m = level_m,
                           // The receiver may have come nearer.
                           .longest_m = by.latest_s * surface.sound_speed_mps + receivers.farthest_m(),
                           .sound_speed_mps = surface.sound_speed_mps,
                           .path = trace::EchoPath::kViaSurface};
    Run::Mirror twice = once;
    twice.scale = 3.0;
    twice.shift_m = -2.0 * level_m;
    twice.amplitude *= of_db(by.head.bottom_mirror_loss_db);
    twice.path = trace::EchoPath::kViaBottom;
    if (by.parts.one_bounce) mirrors_[0] = once;
    if (by.parts.second_bottom) mirrors_[1] = twice;
  }

  bool any() const { return mirrors_[0] || mirrors_[1]; }

  std::array<std::size_t, 2> count(Run& run) const {
    std::array<std::size_t, 2> images{};
    for (std::size_t way = 0; way < 2; ++way) {
      if (mirrors_[way]) images[way] = run.count_images(*mirrors_[way]);
    }
    return images;
  }

  /// Echoes of a run; `before` have been counted in the runs before it.
  void add(Run& run, const std::array<std::size_t, 2>& before, const PairedArrivals& paired, Arrivals& arrivals) const {
    std::array<double, Run::kMost> sent_upa2m2;
    for (std::size_t way = 0; way < 2; ++way) {
      if (!mirrors_[way]) continue;
      const array::Directions launch = run.launch(*mirrors_[way], head_from_enu_);
      if (launch.size() == 0) continue;
      const auto sent = std::span(sent_upa2m2).first(launch.size());
      array::powers(head_.transmit, launch, {}, sent);
      for (double& power : sent) power *= source_upa2m2_;
      const auto [one, other] = paired[(way == 0 ? 0 : paired.scatterers[0]) + before[way]];
      run.by_image(*mirrors_[way], sent, {arrivals, one}, {arrivals, other});
    }
  }

 private:
  const MultipathHead& head_;
  Eigen::Matrix3d head_from_enu_;
  double source_upa2m2_ = power_ratio(head_.source_level_db);  // on the axis
  std::array<std::optional<Run::Mirror>, 2> mirrors_;
};

/// Adds what there is by way of a surface to arrivals, and the direct echoes before it if they are wanted.
PairedArrivals add_echoes(const Carrier& carrier, const frames::HeadPose& pose, const Scatterers& scatterers,
                          const Receivers& receivers, const Multipath& by, std::size_t before, bool direct,
                          EchoMemory& memory, Arrivals& arrivals) {
  const Ways ways(carrier, by, pose, scatterers, receivers);
  const auto each_run = [&](const auto& work) { for_runs(carrier, receivers, pose.position_enu_m, scatterers, work); };
  PairedArrivals paired{before + (direct ? scatterers.size() : 0)};
  auto& images = memory.images;
  images.assign((scatterers.size() + Run::kMost - 1) / Run::kMost, {});
  if (ways.any()) each_run([&](Run& run, std::size_t number) { images[number] = ways.count(run); });
  for (auto& of_run : images) {
    for (std::size_t way = 0; way < 2; ++way) {
      const std::size_t here = std::exchange(of_run[way], paired.scatterers[way]);
      paired.scatterers[way] += here;
    }
  }
  arrivals.resize(paired.end() + (by.parts.surface_echo ? 1 : 0));
  if (direct || paired.pairs() > 0) {
    each_run([&](Run& run, std::size_t number) {
      if (direct) run.direct({arrivals, before + run.first()});
      if (paired.pairs() > 0) ways.add(run, images[number], paired, arrivals);
    });
  }
  if (by.parts.surface_echo) arrivals.set(paired.end(), surface_echo(carrier, by.head, by.surface, pose, receivers));
  return paired;
}

}  // namespace

double surface_reflection(const SurfaceMirror& surface, double frequency_hz, double sin_grazing) {
  return surface::coherent_reflection(wavenumber_radpm(surface, frequency_hz), surface.rms_height_m,
                                      std::asin(std::clamp(sin_grazing, 0.0, 1.0))) *
         of_db(surface.bounce_loss_db);
}

void power_gains(const Arrivals& arrivals, const PairedArrivals& paired, const SharedByBeams* shared,
                 std::span<float> gains) {
  const std::vector<float>& mean_square = arrivals.pressure_re_upa;
  const auto pair = [&](std::size_t i, std::size_t j) {
    const float g = gains[i], h = gains[j], p = mean_square[i], q = mean_square[j];
    gains[i] = g * g, gains[j] = h * h;
    if (!(p > 0.0F && q > 0.0F) || g == 0.0F || h == 0.0F) return;
    const float common = shared ? (*shared)(arrivals.direction_head[i], arrivals.direction_head[j]) : 1.0F;
    const float both = common * g * h;
    gains[i] += both * std::sqrt(q / p);
    gains[j] += both * std::sqrt(p / q);
  };
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (i < paired.first || i >= paired.end()) gains[i] *= gains[i];
  }
  tbb::parallel_for(std::size_t{0}, paired.pairs(), [&](std::size_t i) {
    const auto [one, other] = paired[i];
    pair(one, other);
  });
}

PairedArrivals add_multipath(const Carrier& carrier, const MultipathHead& head, const SurfaceMirror& surface,
                             const MultipathParts& parts, const frames::HeadPose& pose, const Scatterers& scatterers,
                             const Receivers& receivers, Arrivals& arrivals) {
  if (pose.position_enu_m.z() >= surface.level_enu_m) return {};
  EchoMemory memory;
  return add_echoes(carrier, pose, scatterers, receivers, {head, surface, parts}, arrivals.size(), false, memory,
                    arrivals);
}

PairedArrivals make_echoes(const Carrier& carrier, const frames::HeadPose& pose, const Scatterers& scatterers,
                           const Receivers& receivers, const Multipath* multipath, EchoMemory& memory,
                           Arrivals& arrivals) {
  // Room for all ways, even where waves leave none in this ping.
  arrivals.make_room((multipath ? 1 + kMostEach : 1) * scatterers.size() + 1);
  if (multipath && pose.position_enu_m.z() < multipath->surface.level_enu_m)
    return add_echoes(carrier, pose, scatterers, receivers, *multipath, 0, true, memory, arrivals);
  arrivals.resize(scatterers.size());
  for_runs(carrier, receivers, pose.position_enu_m, scatterers, [&](Run& run, std::size_t) {
    run.direct({arrivals, run.first()});
  });
  return {};
}

}  // namespace ensonify::echo
