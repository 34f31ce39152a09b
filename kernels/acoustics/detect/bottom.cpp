#include "kernels/acoustics/detect/bottom.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/detect/beam_series.h"

namespace ensonify::detect {
namespace {

constexpr double kSnippet = 2.5;         // half length in gravity windows, so that the pattern's skirts count
constexpr double kLeastCoherence = 0.6;  // of a phase ramp
constexpr double kMostSlope = 3.0;       // of a phase ramp, over or under the expected one

/// Parts of a beam that hold no echo found so far, in order of time.
class Unexplained {
 public:
  explicit Unexplained(Interval all) { parts_[0] = all; }

  Peak strongest_in(const BeamSeries& series) const {
    Peak best;
    for (int i = 0; i < count_; ++i) {
      const Peak peak = strongest(series, parts_[static_cast<std::size_t>(i)]);
      if (peak.power > best.power) best = peak;
    }
    return best;
  }

  void remove(Interval taken) {
    std::array<Interval, kMostDetections + 1> left;
    std::size_t n = 0;
    for (int i = 0; i < count_; ++i) {
      const Interval part = parts_[static_cast<std::size_t>(i)];
      const Interval before{part.first, std::min(part.end, taken.first)};
      const Interval after{std::max(part.first, taken.end), part.end};
      if (before.first < before.end) left[n++] = before;
      if (after.first < after.end) left[n++] = after;
    }
    parts_ = left;
    count_ = static_cast<int>(n);
  }

 private:
  std::array<Interval, kMostDetections + 1> parts_;  // each removal adds one at most
  int count_ = 1;
};

/// Detects in one beam.
class Beam {
 public:
  Beam(const Settings& settings, const BeamSeries& series, double sin_beam)
      : settings_(settings),
        series_(series),
        seabed_(sin_beam, settings.seabed_tilt_rad, array::half_power_half_width(settings.receive_length_in_waves)),
        noise_(noise_power(series)) {
    const Gates& gates = settings.gates;
    const double seconds_per_m = 2.0 / settings.sound_speed_mps;
    first_s_ = seconds_per_m * std::max(gates.min_range_m, gates.min_depth_m / seabed_.cos_incidence());
    last_s_ = seconds_per_m * std::min(gates.max_range_m, gates.max_depth_m / seabed_.cos_incidence());
  }

  void detect(std::span<Detection> found) const {
    std::fill(found.begin(), found.end(), Detection{});
    const Interval gate{series_.index_from(first_s_), series_.index_from(last_s_ + series_.pulse_length_s)};
    Unexplained unexplained(gate);
    std::size_t count = 0;
    double least_power = 0.0;
    for (; count < found.size(); ++count) {
      const Peak peak = unexplained.strongest_in(series_);
      if (!(peak.power > least_power)) break;
      Detection& detection = found[count];
      detection = detection_at(peak);
      if (detection.flags & (kLowSnr | kNoSignal)) {
        if (count > 0) detection = {};
        break;
      }
      if (count == 0) {
        least_power = peak.power * std::pow(10.0, -0.1 * settings_.second_within_db);
      } else {
        detection.flags |= kNotStrongest;
      }
      unexplained.remove({detection.snippet_first, detection.snippet_first + detection.snippet_count});
    }
    if (count == 0) flag_outside(gate, found.front());
    for (Detection& detection : found) detection.valid = (detection.flags & kRejecting) == 0;
    std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Detection& a, const Detection& b) { return a.two_way_s < b.two_way_s; });
  }

 private:
  Detection detection_at(const Peak& peak) const {
    Detection detection;
    detection.snr_db = snr_db(peak);
    if (detection.snr_db < settings_.gates.snr_db) {
      detection.flags = kLowSnr;
      return detection;
    }
    const double near_s = peak.time_s - 0.5 * series_.pulse_length_s;
    if (near_s <= 0.0) return detection;
    const double loss_np_ps = 0.1 * settings_.absorption_dbpm * std::numbers::ln10 * settings_.sound_speed_mps;
    const Estimate amplitude = centre_of_gravity(series_, seabed_, near_s, noise_, loss_np_ps);
    if (!amplitude.found) return detection;
    detection.flags = 0;
    blend(amplitude, detection);
    take_snippet(amplitude.two_way_s, detection);
    if (detection.two_way_s < first_s_ || detection.two_way_s > last_s_) detection.flags |= kOutOfGate;
    return detection;
  }

  float snr_db(const Peak& peak) const {
    return static_cast<float>(10.0 * std::log10(peak.power / std::max(noise_, 1e-12 * peak.power)));
  }

  void blend(const Estimate& amplitude, Detection& detection) const {
    PhaseRamp ramp;
    if (!series_.positive_upa.empty()) {
      ramp = fit_phase_ramp(series_, seabed_, amplitude.two_way_s, settings_.phase_centres_in_waves);
      const bool ramp_like =
          ramp.coherence >= kLeastCoherence && ramp.slope <= kMostSlope && ramp.slope >= 1.0 / kMostSlope;
      if (ramp.crossing.found && !ramp_like) {
        detection.flags |= kPoorFit;
        ramp.crossing.found = false;
      }
    }
    const double amplitude_variance = amplitude.sd_s * amplitude.sd_s;
    const double phase_variance = ramp.crossing.sd_s * ramp.crossing.sd_s;
    const double weight =
        ramp.crossing.found ? amplitude_variance / std::max(amplitude_variance + phase_variance, 1e-300) : 0.0;
    detection.two_way_s = (1.0 - weight) * amplitude.two_way_s + weight * ramp.crossing.two_way_s;
    detection.phase_weight = static_cast<float>(weight);
    detection.range_sd_m = static_cast<float>((1.0 - weight) * 0.5 * settings_.sound_speed_mps * amplitude.sd_s);
    detection.angle_sd_rad = static_cast<float>(weight * ramp.angle_sd_rad);
    const double sd_s = std::hypot((1.0 - weight) * amplitude.sd_s, weight * ramp.crossing.sd_s);
    detection.quality = static_cast<float>(-std::log10(std::max(sd_s / detection.two_way_s, 1e-12)));
  }

  void take_snippet(double centre_s, Detection& detection) const {
    const double window_s = gravity_window_s(series_, seabed_, centre_s);
    if (centre_s - window_s < series_.start_s || centre_s + window_s > series_.time_s(series_.samples() - 1)) {
      detection.flags |= kCutOff;
    }
    detection.snippet_first = series_.index_from(centre_s - kSnippet * window_s);
    detection.snippet_count = series_.index_from(centre_s + kSnippet * window_s) - detection.snippet_first;
    double energy = 0.0;
    for (int k = 0; k < detection.snippet_count; ++k) energy += series_.power(detection.snippet_first + k) - noise_;
    detection.echo_energy_db = static_cast<float>(10.0 * std::log10(std::max(energy * series_.period_s, 1e-30)));
  }

  /// Nothing passed inside the gates; perhaps something does outside.
  void flag_outside(Interval gate, Detection& detection) const {
    Unexplained outside({0, series_.samples()});
    outside.remove(gate);
    const Peak peak = outside.strongest_in(series_);
    if (peak.power > 0.0 && snr_db(peak) >= settings_.gates.snr_db) detection.flags |= kOutOfGate;
  }

  const Settings& settings_;
  const BeamSeries& series_;
  ExpectedSeabed seabed_;
  double noise_;
  double first_s_, last_s_;  // gates
};

void require_positive(const char* name, double value) {
  if (!(value > 0.0) || std::isinf(value)) {
    throw std::invalid_argument(std::string("detect_bottom: ") + name + " is " + std::to_string(value) +
                                "; finite numbers above 0 are allowed");
  }
}

void check(const Settings& settings, std::size_t beams, const Amplitudes& image, const HalfApertures& halves) {
  const std::size_t size = beams * static_cast<std::size_t>(image.samples);
  if (image.beams != static_cast<int>(beams) || image.amplitude_upa.size() != size) {
    throw std::invalid_argument("detect_bottom: " + std::to_string(beams) + " beams, but an image of " +
                                std::to_string(image.beams) + " x " + std::to_string(image.samples) + " with " +
                                std::to_string(image.amplitude_upa.size()) + " amplitudes");
  }
  if (halves.positive_upa.size() != halves.negative_upa.size() ||
      (!halves.positive_upa.empty() && halves.positive_upa.size() != size)) {
    throw std::invalid_argument("detect_bottom: half apertures of " + std::to_string(halves.positive_upa.size()) +
                                " and " + std::to_string(halves.negative_upa.size()) + " samples; none or " +
                                std::to_string(size) + " are allowed");
  }
  require_positive("pulse_length_s", settings.pulse_length_s);
  require_positive("sound_speed_mps", settings.sound_speed_mps);
  require_positive("receive_length_in_waves", settings.receive_length_in_waves);
  require_positive("phase_centres_in_waves", settings.phase_centres_in_waves);
  require_positive("period_s", image.period_s);
  if (settings.max_detections < 1 || settings.max_detections > kMostDetections) {
    throw std::invalid_argument("detect_bottom: max_detections is " + std::to_string(settings.max_detections) +
                                "; 1 to " + std::to_string(kMostDetections) + " are allowed");
  }
}

}  // namespace

void detect_bottom(const Settings& settings, std::span<const float> sin_beams, const Amplitudes& image,
                   const HalfApertures& halves, std::vector<Detection>& detections) {
  check(settings, sin_beams.size(), image, halves);
  const auto samples = static_cast<std::size_t>(image.samples);
  const auto most = static_cast<std::size_t>(settings.max_detections);
  detections.resize(sin_beams.size() * most);
  const auto detect_in = [&](std::size_t beam, const Settings& by) {
    const auto row = [&](auto all) { return all.empty() ? all : all.subspan(beam * samples, samples); };
    const BeamSeries series{row(image.amplitude_upa), row(halves.positive_upa), row(halves.negative_upa), image.start_s,
                            image.period_s,           settings.pulse_length_s};
    Beam(by, series, sin_beams[beam]).detect(std::span(detections).subspan(beam * most, most));
  };
  tbb::parallel_for(std::size_t{0}, sin_beams.size(), [&](std::size_t beam) { detect_in(beam, settings); });
  if (!settings.second_echo.refused) return;
  for (const DetectedSecondEcho& second : second_echoes(settings, sin_beams, detections)) {
    Settings short_of_it = settings;
    short_of_it.gates.max_range_m = std::min(settings.gates.max_range_m, second.farthest_m);
    detect_in(second.beam, short_of_it);
  }
}

void detect_bottom(const Settings& settings, std::span<const float> sin_beams, const Amplitudes& image,
                   std::vector<Detection>& detections) {
  detect_bottom(settings, sin_beams, image, {}, detections);
}

double beam_area_m2(double range_m, double sin_beam, double transmit_length_in_waves, double receive_length_in_waves) {
  return range_m * range_m / (transmit_length_in_waves * receive_length_in_waves * (1.0 - sin_beam * sin_beam));
}

}  // namespace ensonify::detect
