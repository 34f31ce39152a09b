#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/detect/beam_series.h"

namespace ensonify::detect {
namespace {

constexpr double kNeighboursInWidths = 5.0;  // to either side, in half-power widths of the beam
constexpr std::size_t kMostNeighbours = 32;  // to either side
constexpr double kAtTheSecond = 0.05;        // of its depth: nearer to it is taken for it

/// The swath as its beams' strongest detections give it.
class Swath {
 public:
  Swath(const Settings& settings, std::span<const float> sin_beams, std::span<const Detection> detections)
      : settings_(settings),
        sin_beams_(sin_beams),
        detections_(detections),
        most_(static_cast<std::size_t>(settings.max_detections)),
        reach_(kNeighboursInWidths * 2.0 * array::half_power_half_width(settings.receive_length_in_waves)),
        cos_tilt_(std::cos(settings.seabed_tilt_rad)),
        sin_tilt_(std::sin(settings.seabed_tilt_rad)) {}

  std::span<const Detection> of(std::size_t beam) const { return detections_.subspan(beam * most_, most_); }

  /// Cosine of the incidence on the expected seabed; 0 along it and above.
  double cosine(std::size_t beam) const {
    const double sine = static_cast<double>(sin_beams_[beam]);
    return std::max(std::sqrt(std::max(1.0 - sine * sine, 0.0)) * cos_tilt_ + sine * sin_tilt_, 0.0);
  }
  /// Below the head, along the expected seabed's normal.
  double depth_m(std::size_t beam, const Detection& detected) const {
    return 0.5 * settings_.sound_speed_mps * detected.two_way_s * cosine(beam);
  }

  /// The bottom as the beams about this one receive it: the deeper one of both sides', so that a drop is none that has
  /// its like on one side. Near an end of the swath the inner side decides. 0 without neighbours.
  double bottom_about_m(std::size_t beam) const {
    const Side before = beside(beam, -1), after = beside(beam, 1);
    if (2 * before.beams < after.beams) return after.bottom_m;
    if (2 * after.beams < before.beams) return before.bottom_m;
    return std::max(before.bottom_m, after.bottom_m);
  }

 private:
  struct Side {
    std::size_t beams = 0;
    double bottom_m = 0.0;  // median over those that found it, of an even number the deeper of the two in the middle
  };

  Side beside(std::size_t beam, std::ptrdiff_t step) const {
    Side side;
    std::array<double, kMostNeighbours> depths{};
    std::size_t count = 0;
    const auto end = static_cast<std::ptrdiff_t>(sin_beams_.size());
    for (auto i = static_cast<std::ptrdiff_t>(beam) + step; i >= 0 && i < end && side.beams < depths.size();
         i += step) {
      const auto other = static_cast<std::size_t>(i);
      if (std::abs(static_cast<double>(sin_beams_[other]) - static_cast<double>(sin_beams_[beam])) > reach_) break;
      ++side.beams;
      for (const Detection& detected : of(other)) {
        if (detected.valid && (detected.flags & kNotStrongest) == 0) depths[count++] = depth_m(other, detected);
      }
    }
    if (count == 0) return side;
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(depths.begin(), middle, depths.begin() + static_cast<std::ptrdiff_t>(count));
    side.bottom_m = *middle;
    return side;
  }

  const Settings& settings_;
  std::span<const float> sin_beams_;
  std::span<const Detection> detections_;
  std::size_t most_;
  double reach_, cos_tilt_, sin_tilt_;
};

}  // namespace

std::vector<DetectedSecondEcho> second_echoes(const Settings& settings, std::span<const float> sin_beams,
                                              std::span<const Detection> detections) {
  const Swath swath(settings, sin_beams, detections);
  std::vector<DetectedSecondEcho> found;
  for (std::size_t beam = 0; beam < sin_beams.size(); ++beam) {
    const double bottom_m = swath.bottom_about_m(beam);
    if (bottom_m <= 0.0) continue;
    const double second_m = 2.0 * bottom_m + settings.second_echo.head_depth_m;  // as if it came straight
    const bool detected = std::ranges::any_of(swath.of(beam), [&](const Detection& detection) {
      return detection.valid && std::abs(swath.depth_m(beam, detection) - second_m) < kAtTheSecond * second_m;
    });
    if (detected) found.push_back({beam, (1.0 - kAtTheSecond) * second_m / swath.cosine(beam)});
  }
  return found;
}

}  // namespace ensonify::detect
