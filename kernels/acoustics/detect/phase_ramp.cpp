#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/detect/beam_series.h"
#include "kernels/base/fast_math/fast_math.h"

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

/// Samples that may indicate the ramp.
Interval window_about(const BeamSeries& series, const ExpectedSeabed& seabed, double axis_s) {
  const double half = 0.5 * (kWindow * seabed.footprint_s(axis_s) + series.pulse_length_s);
  const double middle = axis_s + 0.5 * series.pulse_length_s;
  return {series.index_from(std::max(middle - half, seabed.nearest_s(axis_s) + 0.5 * series.pulse_length_s)),
          series.index_from(middle + half)};
}

constexpr std::size_t kRun = 512;    // samples whose numbers stay in the first cache
constexpr std::size_t kMargin = 16;  // by which the window may move from pass to pass

template <class T>
using Column = std::array<T, kRun>;

/// The halves' interferogram by magnitude and phase, which are the same for every model.
class Interferogram {
 public:
  explicit Interferogram(const BeamSeries& series) : series_(series) {}

  struct Samples {
    const double* weight;
    const float* turns;
  };
  /// Of `count` samples from `first` on, kRun at most.
  Samples of(std::size_t first, std::size_t count) {
    if (first < first_ || first + count > first_ + count_) {
      first_ = count + 2 * kMargin > kRun || first < kMargin ? first : first - kMargin;
      count_ = std::min({kRun, first + count + kMargin - first_, series_.positive_upa.size() - first_});
      find();
    }
    return {weight_.data() + (first - first_), turns_.data() + (first - first_)};
  }

 private:
  void find() {
    const std::complex<float>* const positive_upa = series_.positive_upa.data() + first_;
    const std::complex<float>* const negative_upa = series_.negative_upa.data() + first_;
    alignas(64) Column<double> re, im;
    for (std::size_t i = 0; i < count_; ++i) {
      const auto a = static_cast<double>(positive_upa[i].real()), b = static_cast<double>(positive_upa[i].imag());
      const auto c = static_cast<double>(negative_upa[i].real()), d = static_cast<double>(negative_upa[i].imag());
      re[i] = a * c + b * d;
      im[i] = b * c - a * d;
    }
    for (std::size_t i = 0; i < count_; ++i) weight_[i] = std::sqrt(re[i] * re[i] + im[i] * im[i]);
    for (std::size_t i = 0; i < count_; ++i)
      turns_[i] = fast_math::turns_of(static_cast<float>(re[i]), static_cast<float>(im[i]));
  }

  const BeamSeries& series_;
  std::size_t first_ = 0, count_ = 0;
  alignas(64) Column<double> weight_;
  alignas(64) Column<float> turns_;
};

/// What a line is fitted to.
struct Observed {
  const BeamSeries& series;
  const ExpectedSeabed seabed;
  double radians_per_sine;
  Interferogram interferogram;
};

/// Samples of the window, against a model.
struct Residuals {
  const double* weight;
  alignas(64) Column<double> off_axis;  // sine from the beam's axis
  alignas(64) Column<double> rad;       // of the interferogram turned back by the model
};

/// use(residuals, count) for runs of the window.
template <typename Use>
void for_each_run(Observed& beam, const Model& model, const Use& use) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  const Interval window = window_about(beam.series, beam.seabed, model.axis_s);
  const ExpectedSeabed seabed = beam.seabed;
  const double start_s = beam.series.start_s - 0.5 * beam.series.pulse_length_s, period_s = beam.series.period_s;
  const double axis_s = model.axis_s, turns_per_sine = beam.radians_per_sine * model.slope / kTurn_rad;
  Residuals found;
  for (int first = window.first; first < window.end; first += static_cast<int>(kRun)) {
    const std::size_t count = std::min(kRun, static_cast<std::size_t>(window.end - first));
    const Interferogram::Samples samples = beam.interferogram.of(static_cast<std::size_t>(first), count);
    found.weight = samples.weight;
    for (std::size_t i = 0; i < count; ++i) {
      const double echo_s = start_s + (first + static_cast<int>(i)) * period_s;
      found.off_axis[i] = seabed.sine_at(echo_s, axis_s) - seabed.sin_beam();
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double turns = static_cast<double>(samples.turns[i]) - turns_per_sine * found.off_axis[i];
      found.rad[i] = kTurn_rad * (turns - std::rint(turns));
    }
    use(found, count);
  }
}

/// Sums of columns, number by number into eight.
class Sums {
 public:
  template <typename Number>
  void add(std::size_t count, const Number& number) {
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) lanes_[lane] += number(i + lane);
    }
    for (; i < count; ++i) lanes_[i % kLanes] += number(i);
  }
  double sum() const {
    double all = 0.0;
    for (const double lane : lanes_) all += lane;
    return all;
  }

 private:
  static constexpr std::size_t kLanes = 8;
  alignas(64) std::array<double, kLanes> lanes_{};
};

/// Weighted line through the residuals.
struct Line {
  double weight = 0.0, mean_x = 0.0, scatter_x = 0.0;  // scatter_x: with the prior's share
  double offset = 0.0, slope = 0.0;                    // rad, rad per sine
};

Line fit(Observed& beam, const Model& model) {
  Sums of, of_x, of_y, of_xx, of_xy, of_yy;
  for_each_run(beam, model, [&](const Residuals& found, std::size_t count) {
    const double *const weight = found.weight, *const x = found.off_axis.data(), *const y = found.rad.data();
    of.add(count, [=](std::size_t i) { return weight[i]; });
    of_x.add(count, [=](std::size_t i) { return weight[i] * x[i]; });
    of_y.add(count, [=](std::size_t i) { return weight[i] * y[i]; });
    of_xx.add(count, [=](std::size_t i) { return weight[i] * x[i] * x[i]; });
    of_xy.add(count, [=](std::size_t i) { return weight[i] * x[i] * y[i]; });
    of_yy.add(count, [=](std::size_t i) { return weight[i] * y[i] * y[i]; });
  });
  const double w = of.sum(), wx = of_x.sum(), wy = of_y.sum(), wxx = of_xx.sum(), wxy = of_xy.sum(), wyy = of_yy.sum();
  if (!(w > 0.0)) return {};
  const double mean_x = wx / w, mean_y = wy / w, radians_per_sine = beam.radians_per_sine;
  const double pulses = 1.0 + kWindow * beam.seabed.footprint_s(model.axis_s) / beam.series.pulse_length_s;
  const double prior_sd = kSlopePriorSd * radians_per_sine;
  const double variance_y = std::max(wyy / w - mean_y * mean_y, 0.0);
  const double prior = variance_y / (prior_sd * prior_sd) * w / pulses;
  const double scatter_x = std::max(wxx - w * mean_x * mean_x, 0.0) + prior;
  if (!(scatter_x > 0.0)) return {w, mean_x, 0.0, mean_y, 0.0};
  // The prior is about the expected slope, 1, not about the model's.
  const double slope = (wxy - w * mean_x * mean_y + prior * (1.0 - model.slope) * radians_per_sine) / scatter_x;
  return {w, mean_x, scatter_x, mean_y - slope * mean_x, slope};
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
double offset_variance_rad2(Observed& beam, const Model& model, const Line& line) {
  const int per_pulse = beam.series.samples_per_pulse();
  double run = 0.0, squares = 0.0;
  int in_run = 0, runs = 0;
  const auto close = [&] {
    squares += run * run;
    run = 0.0;
    in_run = 0;
    ++runs;
  };
  for_each_run(beam, model, [&](const Residuals& found, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!(found.weight[i] > 0.0)) continue;
      const double lever =
          line.scatter_x > 0.0 ? line.mean_x * (found.off_axis[i] - line.mean_x) / line.scatter_x : 0.0;
      run += found.weight[i] * found.rad[i] * (1.0 / line.weight - lever);
      if (++in_run == per_pulse) close();
    }
  });
  if (in_run > 0) close();
  const double measured = kOfNeighbours * squares * runs / std::max(runs - 1.0, 1.0);
  const double expected = expected_variance_rad2(beam.series, beam.seabed, beam.radians_per_sine, model.axis_s);
  return (runs * measured + expected) / (runs + 1.0);
}

/// Of the interferogram turned back by the model.
double coherence(Observed& beam, const Model& model) {
  constexpr double kPerTurn = 0.5 * std::numbers::inv_pi;
  Sums re, im, magnitudes;
  for_each_run(beam, model, [&](const Residuals& found, std::size_t count) {
    alignas(64) Column<float> cosine, sine;
    for (std::size_t i = 0; i < count; ++i) {
      const auto direction = fast_math::direction(static_cast<float>(kPerTurn * found.rad[i]));
      cosine[i] = direction.cosine;
      sine[i] = direction.sine;
    }
    const double* const weight = found.weight;
    re.add(count, [&](std::size_t i) { return weight[i] * static_cast<double>(cosine[i]); });
    im.add(count, [&](std::size_t i) { return weight[i] * static_cast<double>(sine[i]); });
    magnitudes.add(count, [=](std::size_t i) { return weight[i]; });
  });
  return std::hypot(re.sum(), im.sum()) / magnitudes.sum();
}

}  // namespace

PhaseRamp fit_phase_ramp(const BeamSeries& series, const ExpectedSeabed& seabed, double near_s,
                         double phase_centres_in_waves) {
  PhaseRamp ramp;
  if (std::abs(seabed.sin_incidence()) < 2.0 * seabed.half_width()) return ramp;
  if (seabed.footprint_s(near_s) < kShortestFootprint * series.pulse_length_s) return ramp;
  const double radians_per_sine = 2.0 * std::numbers::pi * phase_centres_in_waves;
  Observed beam{series, seabed, radians_per_sine, Interferogram(series)};
  Model model{near_s};
  Line line = fit(beam, model);
  for (int pass = 0; pass < kMostPasses && line.weight > 0.0; ++pass) {
    model.slope = std::clamp(model.slope + line.slope / radians_per_sine, kFlattest, kSteepest);
    const double crossing =
        std::clamp(-line.offset / (radians_per_sine * model.slope), -seabed.half_width(), seabed.half_width());
    const double before_s = model.axis_s;
    model.axis_s = seabed.time_at(seabed.sin_beam() + crossing, model.axis_s);
    line = fit(beam, model);
    if (std::abs(model.axis_s - before_s) < kConverged * before_s) break;
  }
  if (!(line.weight > 0.0)) return ramp;
  ramp.coherence = coherence(beam, model);
  ramp.slope = model.slope;
  const double sine_sd = std::sqrt(offset_variance_rad2(beam, model, line)) / (radians_per_sine * model.slope);
  ramp.angle_sd_rad = sine_sd / seabed.cos_beam();
  ramp.crossing = {true, model.axis_s, model.axis_s * seabed.tan_incidence() * ramp.angle_sd_rad};
  return ramp;
}

}  // namespace ensonify::detect
