#include "kernels/acoustics/echo/multipath.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/sea_surface.h"

namespace ensonify::echo {
namespace {

using frames::Vec3;

constexpr std::size_t kPerTask = 1024;
constexpr double kLeastReflection = 1e-5;

Vec3 mirrored(const Vec3& point, double level_m) { return {point.x(), point.y(), 2.0 * level_m - point.z()}; }

/// What all paths of one ping share.
struct Paths {
  const Carrier& carrier;
  const MultipathHead& head;
  const SurfaceMirror& surface;
  const frames::HeadPose& pose;
  const Receivers& receivers;
  double source_upa2m2 = power_ratio(head.source_level_db);  // on the axis
  double bottom_mirror = std::pow(10.0, -0.05 * head.bottom_mirror_loss_db);

  Eigen::Vector3f launch(const Vec3& target) const {
    return (pose.enu_from_head.conjugate() * (target - pose.position_enu_m).normalized()).cast<float>();
  }

  /// Mean-square pressure at 1 m that leaves towards a point or an image, uPa^2 m^2.
  double source_towards(const Vec3& target) const {
    return source_upa2m2 * array::power(head.transmit, launch(target));
  }

  /// The arrival that left a scatterer (or its image) at `from` with mean square `at_1m`, after `out_m` of path, with
  /// the reflections' amplitude `reflected` already in it.
  Arrival arrive(const Scatterer& scatterer, double at_1m, double reflected, double out_m, const Vec3& from) const {
    const double guess_m = (from - pose.position_enu_m).norm();
    const Receivers::At receiver = receivers.at((out_m + guess_m) / surface.sound_speed_mps);
    const Vec3 back = from - receiver.position_enu_m;
    const double back_m = std::max(back.norm(), 1e-3), total_m = out_m + back_m;
    const double mean_square =
        at_1m * reflected * reflected * power_ratio(-carrier.absorption_dbpm * total_m) / (back_m * back_m);
    Arrival arrival;
    arrival.time_s = total_m / surface.sound_speed_mps;
    const std::complex<float> response = reflected < 0.0 ? -scatterer.response : scatterer.response;
    arrival.pressure_upa = scatterer.share * echo_pressure(carrier, mean_square, arrival.time_s, response);
    arrival.direction_head = receiver.head_from_enu * (back / back_m).cast<float>();
    return arrival;
  }

  double reflection(const Vec3& from, const Vec3& to) const {
    const Vec3 leg = to - from;
    return surface_reflection(surface, carrier.frequency_hz, std::abs(leg.z()) / std::max(leg.norm(), 1e-9));
  }

  /// Where a scatterer seems to be, from the head: seabed - surface, and the same in the other order.
  Vec3 one_bounce(const Vec3& place) const { return mirrored(place, surface.level_enu_m); }

  /// A mirror's bounce off the seabed, then the surface, then the scatterer; and back the same way in the other order:
  /// mirrored at the surface and then at the seabed's level.
  Vec3 second_bottom(const Vec3& place) const { return mirrored(mirrored(place, surface.level_enu_m), place.z()); }

  /// Out directly and back from the image, and the other way round. `sent` leaves towards the image, uPa^2 m^2;
  /// `mirror` is the amplitude that mirrors besides the surface reflect.
  std::array<Arrival, 2> by_image(const Scatterer& scatterer, const Vec3& image, double mirror, double sent) const {
    const Vec3& place = scatterer.position_enu_m;
    const double direct_m = (place - pose.position_enu_m).norm(), bounced_m = (image - pose.position_enu_m).norm();
    const double V = reflection(pose.position_enu_m, image) * mirror;
    const double insonified = sent * scatterer.cross_section_m2 / (bounced_m * bounced_m);
    return {arrive(scatterer, scatterer.scattered_upa2m2, V, direct_m, image),
            arrive(scatterer, insonified, V, bounced_m, place)};
  }

  /// The head's own sound by way of mirrors. It seems to come from `image` and left as if for `target`, the images of
  /// the source and of the receiver. The carrier's phase is the path's; no draw.
  Arrival mirror_echo(const Vec3& image, const Vec3& target, double reflected) const {
    const double whole_m = (image - pose.position_enu_m).norm();
    const Receivers::At receiver = receivers.at(whole_m / surface.sound_speed_mps);
    const Vec3 back = image - receiver.position_enu_m;
    const double path_m = std::max(back.norm(), 1e-3);
    const double mean_square = source_towards(target) * reflected * reflected *
                               power_ratio(-carrier.absorption_dbpm * path_m) / (path_m * path_m);
    Arrival arrival;
    arrival.time_s = path_m / surface.sound_speed_mps;
    arrival.pressure_upa = echo_pressure(carrier, mean_square, arrival.time_s, reflected < 0.0 ? -1.0F : 1.0F);
    arrival.direction_head = receiver.head_from_enu * (back / path_m).cast<float>();
    return arrival;
  }
};

/// What leaves towards the images of some scatterers.
class Sources {
 public:
  static constexpr std::size_t kMost = kPerTask;

  template <class ImageOf>
  void set(const Paths& paths, const Scatterers& scatterers, std::size_t begin, std::size_t count,
           const ImageOf& image_of) {
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f launch = paths.launch(image_of(scatterers.position_enu_m[begin + i]));
      x_[i] = launch.x(), y_[i] = launch.y(), z_[i] = launch.z();
    }
    const auto first = [count](const std::array<float, kMost>& all) { return std::span(all).first(count); };
    array::powers(paths.head.transmit, {first(x_), first(y_), first(z_)}, {}, std::span(power_).first(count));
    source_upa2m2_ = paths.source_upa2m2;
  }
  double operator[](std::size_t i) const { return source_upa2m2_ * power_[i]; }

 private:
  std::array<float, kMost> x_, y_, z_;
  std::array<double, kMost> power_;
  double source_upa2m2_ = 0.0;
};

/// Of the surface on the way to any of the scatterers: waves leave most where it is hit at the lowest angle.
double strongest_reflection(const Paths& paths, const Scatterers& scatterers) {
  double least_sine = 1.0;
  for (std::size_t i = 0; i < scatterers.size(); ++i) {
    const Vec3 leg = mirrored(scatterers.position_enu_m[i], paths.surface.level_enu_m) - paths.pose.position_enu_m;
    least_sine = std::min(least_sine, std::abs(leg.z()) / std::max(leg.norm(), 1e-9));
  }
  return std::abs(surface_reflection(paths.surface, paths.carrier.frequency_hz, least_sine));
}

}  // namespace

double surface_reflection(const SurfaceMirror& surface, double frequency_hz, double sin_grazing) {
  const double wavenumber_radpm = 2.0 * std::numbers::pi * frequency_hz / surface.sound_speed_mps;
  const double grazing_rad = std::asin(std::clamp(sin_grazing, 0.0, 1.0));
  return surface::coherent_reflection(wavenumber_radpm, surface.rms_height_m, grazing_rad) *
         std::pow(10.0, -0.05 * surface.bounce_loss_db);
}

void power_gains(const Arrivals& arrivals, const PairedArrivals& paired, const SharedByBeams* shared,
                 std::span<float> gains) {
  const std::vector<float>& mean_square = arrivals.pressure_re_upa;
  const auto pair = [&](std::size_t i) {
    const std::size_t j = i + 1;
    const float g = gains[i], h = gains[j], p = mean_square[i], q = mean_square[j];
    gains[i] = g * g, gains[j] = h * h;
    if (!(p > 0.0F && q > 0.0F) || g == 0.0F || h == 0.0F) return;
    const float common = shared ? (*shared)(arrivals.direction_head[i], arrivals.direction_head[j]) : 1.0F;
    const float both = common * g * h;
    gains[i] += both * std::sqrt(q / p);
    gains[j] += both * std::sqrt(p / q);
  };
  const std::size_t end = paired.first + 2 * paired.pairs;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (i < paired.first || i >= end) gains[i] *= gains[i];
  }
  tbb::parallel_for(std::size_t{0}, paired.pairs, [&](std::size_t i) { pair(paired.first + 2 * i); });
}

PairedArrivals add_multipath(const Carrier& carrier, const MultipathHead& head, const SurfaceMirror& surface,
                             const MultipathParts& parts, const frames::HeadPose& pose, const Scatterers& scatterers,
                             const Receivers& receivers, Arrivals& arrivals) {
  const double level_m = surface.level_enu_m;
  if (pose.position_enu_m.z() >= level_m) return {};
  const Paths paths{carrier, head, surface, pose, receivers};
  const bool mirrors = strongest_reflection(paths, scatterers) >= kLeastReflection;
  const std::size_t each = mirrors ? (parts.one_bounce ? 2U : 0U) + (parts.second_bottom ? 2U : 0U) : 0U;
  const std::size_t before = arrivals.size();
  arrivals.resize(before + each * scatterers.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, each == 0 ? 0 : scatterers.size(), kPerTask),
      [&](const auto& range) {
        Sources bounced, second;
        const auto one_bounce = [&](const Vec3& place) { return paths.one_bounce(place); };
        const auto second_bottom = [&](const Vec3& place) { return paths.second_bottom(place); };
        if (parts.one_bounce) bounced.set(paths, scatterers, range.begin(), range.size(), one_bounce);
        if (parts.second_bottom) second.set(paths, scatterers, range.begin(), range.size(), second_bottom);
        for (std::size_t i = 0; i < range.size(); ++i) {
          const Scatterer one = scatterers[range.begin() + i];
          const Vec3& place = one.position_enu_m;
          std::size_t out = before + each * (range.begin() + i);
          if (place.z() >= level_m) {
            for (std::size_t k = 0; k < each; ++k) arrivals.set(out + k, Arrival{});
            continue;
          }
          const auto add = [&](const std::array<Arrival, 2>& pair, trace::EchoPath path) {
            for (Arrival arrival : pair) {
              arrival.contributor = trace::by_path(one.contributor, path);
              arrivals.set(out++, arrival);
            }
          };
          using Path = trace::EchoPath;
          if (parts.one_bounce) add(paths.by_image(one, one_bounce(place), 1.0, bounced[i]), Path::kViaSurface);
          if (parts.second_bottom)
            add(paths.by_image(one, second_bottom(place), paths.bottom_mirror, second[i]), Path::kViaBottom);
        }
      },
      tbb::simple_partitioner());
  if (parts.surface_echo) {
    const double V = surface_reflection(surface, carrier.frequency_hz, 1.0);
    const Vec3 above = mirrored(pose.position_enu_m, level_m);
    arrivals.push_back(paths.mirror_echo(above, above, V));
  }
  return {before, each * scatterers.size() / 2};
}

}  // namespace ensonify::echo
