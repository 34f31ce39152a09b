#include <numbers>

#include "kernels/acoustics/detect/beam_series.h"

namespace ensonify::detect {
namespace {

constexpr double kWindow = 1.5;  // footprints
// Pulses that a footprint lasts at least where its phase is a ramp. A shorter one is received all at once, and what a
// whole beam receives at once is incoherent between its halves (van Cittert and Zernike). Here both errors are equal
// (simulated).
constexpr double kShortestFootprint = 2.0 / 3.0;
constexpr int kMostPasses = 6;
constexpr double kConverged = 1e-6;                 // relative; a hundredth of the best standard deviation
constexpr double kSlopePriorSd = 0.5;               // of the slope over the expected one
constexpr double kFlattest = 0.2, kSteepest = 5.0;  // slopes over the expected one
constexpr double kLeastModelCoherence = 0.3;        // below it there is no phase to speak of
// Variance of a long sum over that of its pulse-long runs each on its own. Behind a tone's filter samples are
// correlated as 1 - lag / pulse: a run has 2/3 of its pulse squared, and shares 1/6 with each neighbour.
constexpr double kOfNeighbours = 1.5;

/// The phase is expected to be radians_per_sine * slope * (sine - sine of the beam).
struct Model {
  double axis_s;
  double slope = 1.0;
};

/// Samples [first, end) that may indicate the ramp.
struct Window {
  int first, end;
};

Window window_about(const BeamSeries& series, const ExpectedSeabed& seabed, double axis_s) {
  const double half = 0.5 * (kWindow * seabed.footprint_s(axis_s) + series.pulse_length_s);
  const double middle = axis_s + 0.5 * series.pulse_length_s;
  return {series.index_from(std::max(middle - half, seabed.nearest_s(axis_s) + 0.5 * series.pulse_length_s)),
          series.index_from(middle + half)};
}

struct Sample {
  double off_axis;  // sine from the beam's axis
  double weight, residual_rad;
  std::complex<double> turned;  // interferogram turned back by the model
};

template <typename Use>
void for_each_sample(const BeamSeries& series, const ExpectedSeabed& seabed, double radians_per_sine,
                     const Model& model, const Use& use) {
  const Window window = window_about(series, seabed, model.axis_s);
  for (int k = window.first; k < window.end; ++k) {
    const double off_axis = seabed.sine_at(series.echo_s(k), model.axis_s) - seabed.sin_beam();
    const std::complex<double> turned =
        series.interferogram(k) * std::polar(1.0, -radians_per_sine * model.slope * off_axis);
    const double weight = std::abs(turned);
    if (weight > 0.0) use(Sample{off_axis, weight, std::arg(turned), turned});
  }
}

/// Weighted line through the residuals.
struct Line {
  double weight = 0.0, mean_x = 0.0, scatter_x = 0.0;  // scatter_x: with the prior's share
  double offset = 0.0, slope = 0.0;                    // rad, rad per sine
  double coherence = 0.0;                              // of the interferogram turned back
};

Line fit(const BeamSeries& series, const ExpectedSeabed& seabed, double radians_per_sine, const Model& model) {
  std::complex<double> sum;
  double w = 0.0, wx = 0.0, wy = 0.0, wxx = 0.0, wxy = 0.0, wyy = 0.0;
  for_each_sample(series, seabed, radians_per_sine, model, [&](const Sample& s) {
    sum += s.turned;
    w += s.weight;
    wx += s.weight * s.off_axis;
    wy += s.weight * s.residual_rad;
    wxx += s.weight * s.off_axis * s.off_axis;
    wxy += s.weight * s.off_axis * s.residual_rad;
    wyy += s.weight * s.residual_rad * s.residual_rad;
  });
  if (!(w > 0.0)) return {};
  const double mean_x = wx / w, mean_y = wy / w, coherence = std::abs(sum) / w;
  const double pulses = 1.0 + kWindow * seabed.footprint_s(model.axis_s) / series.pulse_length_s;
  const double prior_sd = kSlopePriorSd * radians_per_sine;
  const double variance_y = std::max(wyy / w - mean_y * mean_y, 0.0);
  const double prior = variance_y / (prior_sd * prior_sd) * w / pulses;
  const double scatter_x = std::max(wxx - w * mean_x * mean_x, 0.0) + prior;
  if (!(scatter_x > 0.0)) return {w, mean_x, 0.0, mean_y, 0.0, coherence};
  // The prior is about the expected slope, 1, not about the model's.
  const double slope = (wxy - w * mean_x * mean_y + prior * (1.0 - model.slope) * radians_per_sine) / scatter_x;
  return {w, mean_x, scatter_x, mean_y - slope * mean_x, slope, coherence};
}

/// Variance that the decorrelation within a pulse gives the phase at the axis, before anything is heard: the pulse's
/// footprint turns the phase by x, which leaves the coherence sin(x / 2) / (x / 2); per independent pulse the
/// Cramer-Rao bound is (1 - g^2) / (2 g^2) [Lurton2010], and weighing with magnitudes halves the deviation (simulated).
double expected_variance_rad2(const BeamSeries& series, const ExpectedSeabed& seabed, double radians_per_sine,
                              double axis_s) {
  const double half_turn =
      0.5 * radians_per_sine * seabed.cos_beam() * series.pulse_length_s / (axis_s * seabed.tan_incidence());
  const double coherence = std::max(std::sin(std::min(half_turn, std::numbers::pi)) / half_turn, kLeastModelCoherence);
  const double pulses = std::max(seabed.footprint_s(axis_s) / series.pulse_length_s, 1.0);
  return 0.25 * (1.0 - coherence * coherence) / (2.0 * coherence * coherence) / pulses;
}

/// Variance of the fitted phase at the axis: the scatter of what pulse-long runs of samples contribute, and what was
/// expected of it as one run more.
double offset_variance_rad2(const BeamSeries& series, const ExpectedSeabed& seabed, double radians_per_sine,
                            const Model& model, const Line& line) {
  const int per_pulse = series.samples_per_pulse();
  double run = 0.0, squares = 0.0;
  int count = 0, runs = 0;
  const auto close = [&] {
    squares += run * run;
    run = 0.0;
    count = 0;
    ++runs;
  };
  for_each_sample(series, seabed, radians_per_sine, model, [&](const Sample& s) {
    const double lever = line.scatter_x > 0.0 ? line.mean_x * (s.off_axis - line.mean_x) / line.scatter_x : 0.0;
    run += s.weight * s.residual_rad * (1.0 / line.weight - lever);
    if (++count == per_pulse) close();
  });
  if (count > 0) close();
  const double measured = kOfNeighbours * squares * runs / std::max(runs - 1.0, 1.0);
  const double expected = expected_variance_rad2(series, seabed, radians_per_sine, model.axis_s);
  return (runs * measured + expected) / (runs + 1.0);
}

}  // namespace

PhaseRamp fit_phase_ramp(const BeamSeries& series, const ExpectedSeabed& seabed, double near_s,
                         double phase_centres_in_waves) {
  PhaseRamp ramp;
  if (std::abs(seabed.sin_incidence()) < 2.0 * seabed.half_width()) return ramp;
  if (seabed.footprint_s(near_s) < kShortestFootprint * series.pulse_length_s) return ramp;
  const double radians_per_sine = 2.0 * std::numbers::pi * phase_centres_in_waves;
  Model model{near_s};
  Line line = fit(series, seabed, radians_per_sine, model);
  for (int pass = 0; pass < kMostPasses && line.weight > 0.0; ++pass) {
    model.slope = std::clamp(model.slope + line.slope / radians_per_sine, kFlattest, kSteepest);
    const double crossing =
        std::clamp(-line.offset / (radians_per_sine * model.slope), -seabed.half_width(), seabed.half_width());
    const double before_s = model.axis_s;
    model.axis_s = seabed.time_at(seabed.sin_beam() + crossing, model.axis_s);
    line = fit(series, seabed, radians_per_sine, model);
    if (std::abs(model.axis_s - before_s) < kConverged * before_s) break;
  }
  if (!(line.weight > 0.0)) return ramp;
  ramp.coherence = line.coherence;
  ramp.slope = model.slope;
  const double sine_sd =
      std::sqrt(offset_variance_rad2(series, seabed, radians_per_sine, model, line)) / (radians_per_sine * model.slope);
  ramp.angle_sd_rad = sine_sd / seabed.cos_beam();
  ramp.crossing = {true, model.axis_s, model.axis_s * seabed.tan_incidence() * ramp.angle_sd_rad};
  return ramp;
}

}  // namespace ensonify::detect
