#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "kernels/acoustics/detect/bottom.h"

/// Internal to this folder: what one beam received, the seabed it expects, its strongest pulse, its detection by
/// amplitude and by phase, and which beams took the echo by way of the surface for the bottom (bottom.h, SecondEcho).
namespace ensonify::detect {

/// One beam against time. The halves are empty where there is amplitude alone.
struct BeamSeries {
  std::span<const float> amplitude_upa;
  std::span<const std::complex<float>> positive_upa, negative_upa;
  double start_s, period_s, pulse_length_s;

  int samples() const { return static_cast<int>(amplitude_upa.size()); }
  double time_s(int k) const { return start_s + k * period_s; }
  /// Sample k holds the echoes that began within a pulse before it; this is the middle of that interval.
  double echo_s(int k) const { return time_s(k) - 0.5 * pulse_length_s; }
  int index_from(double t_s) const {  // the first sample at or after t
    return static_cast<int>(std::clamp(std::ceil((t_s - start_s) / period_s), 0.0, static_cast<double>(samples())));
  }
  int samples_per_pulse() const { return std::max(1, static_cast<int>(std::lround(pulse_length_s / period_s))); }
  /// How many samples are as good as one: a tone's filter correlates pressures as 1 - lag / pulse, and powers as its
  /// square, whose integral is 2/3 of the pulse.
  int correlated_samples() const { return std::max(1, static_cast<int>(std::lround(2.0 / 3.0 * samples_per_pulse()))); }
  double power(int k) const {
    const double a = amplitude_upa[static_cast<std::size_t>(k)];
    return a * a;
  }
  std::complex<double> interferogram(int k) const {
    const auto i = static_cast<std::size_t>(k);
    return std::complex<double>(positive_upa[i]) * std::conj(std::complex<double>(negative_upa[i]));
  }
};

/// A plane seabed across the track, as a beam expects it: the echo from the angle beta comes at nearest / cos(beta -
/// tilt), where `nearest` is the two-way time along the plane's normal.
class ExpectedSeabed {
 public:
  /// half_width: of the receive beam at half power, in sine.
  ExpectedSeabed(double sin_beam, double tilt_rad, double half_width)
      : sin_beam_(sin_beam),
        cos_beam_(std::max(std::sqrt(std::max(1.0 - sin_beam * sin_beam, 0.0)), half_width)),
        tilt_rad_(tilt_rad),
        sin_tilt_(std::sin(tilt_rad)),
        cos_tilt_(std::cos(tilt_rad)),
        half_width_(half_width) {
    const double incidence_rad = std::asin(std::clamp(sin_beam, -1.0, 1.0)) - tilt_rad;
    sin_incidence_ = std::sin(incidence_rad);
    cos_incidence_ = std::max(std::cos(incidence_rad), half_width);
    side_ = std::copysign(cos_tilt_, incidence_rad);
  }

  double sin_beam() const { return sin_beam_; }
  double cos_beam() const { return cos_beam_; }
  double half_width() const { return half_width_; }
  /// Cosine of the incidence on the plane's normal; a beam along the plane or above it is taken as almost along it.
  double cos_incidence() const { return cos_incidence_; }
  double sin_incidence() const { return sin_incidence_; }
  double tan_incidence() const { return std::abs(sin_incidence()) / cos_incidence(); }

  /// Duration of the plane's echo between the half-power edges of the beam, without the pulse.
  double footprint_s(double two_way_s) const { return two_way_s * tan_incidence() * 2.0 * half_width_ / cos_beam_; }

  /// The sine from which an echo comes at t, if the one at the axis comes at `axis_s`. Before the plane's nearest point
  /// echoes there is none: then the sine of its normal.
  double sine_at(double t_s, double axis_s) const {
    const double cosine = std::min(nearest_s(axis_s) / t_s, 1.0);
    return sin_tilt_ * cosine + side_ * std::sqrt(1.0 - cosine * cosine);
  }
  /// The inverse: when an echo comes from `sine`, if the one at the axis comes at `axis_s`.
  double time_at(double sine, double axis_s) const {
    const double cosine = std::cos(std::asin(std::clamp(sine, -1.0, 1.0)) - tilt_rad_);
    return nearest_s(axis_s) / std::max(cosine, 0.5 * half_width_);
  }
  double nearest_s(double axis_s) const { return axis_s * cos_incidence(); }

 private:
  double sin_beam_, cos_beam_, tilt_rad_, sin_tilt_, cos_tilt_, half_width_;
  double sin_incidence_, cos_incidence_;
  double side_;  // cosine of the tilt, with the sign of the incidence
};

/// Samples [first, end).
struct Interval {
  int first = 0, end = 0;
};

/// Of a beam: the median of at most 256 samples that are spread evenly, over ln 2.
double noise_power(const BeamSeries& series);

struct Peak {
  double power = 0.0;   // mean over a pulse
  double time_s = 0.0;  // middle of that pulse
};

/// The first of the strongest pulses that lie within the interval; of power 0 where nothing is received or it is
/// shorter. In single precision: which of two that differ by less than 1e-6 is chosen by rounding.
Peak strongest(const BeamSeries& series, Interval where);

/// A time from one method, with its predicted standard deviation.
struct Estimate {
  bool found = false;
  double two_way_s = 0.0;
  double sd_s = 0.0;
};

/// Half the window of the centre of gravity about an echo.
inline double gravity_window_s(const BeamSeries& series, const ExpectedSeabed& seabed, double two_way_s) {
  return seabed.footprint_s(two_way_s) + series.pulse_length_s;
}

/// Amplitude detection (bottom.h) of the echo about `near_s`. loss_np_ps: of power, by absorption there and back.
Estimate centre_of_gravity(const BeamSeries& series, const ExpectedSeabed& seabed, double near_s, double noise_power,
                           double loss_np_ps);

struct PhaseRamp {
  Estimate crossing;          // sd_s: as an error of the time at the beam's axis
  double angle_sd_rad = 0.0;  // the same error as one of the direction
  double coherence =
      0.0;             // magnitude of the sum of the interferogram turned back by the fit, over the sum of magnitudes
  double slope = 1.0;  // fitted over expected
};

/// Phase detection (bottom.h) of the echo about `near_s`: where the phase between the halves crosses zero. Not found
/// where the beam points within its own width of the seabed's normal, where its footprint echoes for less than two
/// thirds of a pulse, or where it receives nothing.
PhaseRamp fit_phase_ramp(const BeamSeries& series, const ExpectedSeabed& seabed, double near_s,
                         double phase_centres_in_waves);

/// A beam that received the second echo, and the slant range short of which it is to seek the bottom.
struct DetectedSecondEcho {
  std::size_t beam = 0;
  double farthest_m = 0.0;
};

/// In order of beams. detections: max_detections of each beam, as detect_bottom leaves them. Allocates for what it
/// finds only.
std::vector<DetectedSecondEcho> second_echoes(const Settings& settings, std::span<const float> sin_beams,
                                              std::span<const Detection> detections);

}  // namespace ensonify::detect
