#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/detect/beam_series.h"
#include "kernels/base/fast_math/fast_math.h"

namespace ensonify::detect {
namespace {

constexpr int kRun = 128;  // samples whose numbers stay in the first cache
constexpr int kPasses = 4;

using Column = std::array<double, kRun>;

/// Sum of the first numbers of a column, in an order that depends on their count alone.
double sum_of(const Column& column, int count) {
  return Eigen::Map<const Eigen::ArrayXd, Eigen::Aligned64>(column.data(), count).sum();
}

/// A window about an echo. Its samples weigh with their power less noise, as it would be without absorption.
class Window {
 public:
  Window(const BeamSeries& series, double middle_s, double half_window_s, double noise, double loss_np_ps)
      : series_(series),
        middle_s_(middle_s),
        noise_(noise),
        loss_per_s_(loss_np_ps / std::numbers::ln2),
        first_(series.index_from(std::max(middle_s - half_window_s, 0.5 * series.pulse_length_s))),
        end_(series.index_from(middle_s + half_window_s)) {
    if (first_ < end_ && !(series.echo_s(first_) > 0.0)) ++first_;
    weigh();
  }

  bool found() const { return weight_ > 0.0 && inverse_square_ > 0.0; }
  double centre_s() const { return middle_s_ * std::sqrt(weight_ / inverse_square_); }

  /// Standard deviation of the power about the centre.
  double spread_s() const {
    double first_moment = 0.0, second_moment = 0.0;
    for (int k = first_; k < end_; k += kRun) {
      const int count = std::min(kRun, end_ - k);
      alignas(64) Column first, second;
      at(k, count, [&](std::size_t i, double t, double power, double gain) {
        const double ratio = t / middle_s_, off = t - middle_s_;
        first[i] = (power - noise_) * gain * ratio * ratio * off;
        second[i] = first[i] * off;
      });
      first_moment += sum_of(first, count);
      second_moment += sum_of(second, count);
    }
    const double mean = first_moment / weight_;
    return std::sqrt(std::max(second_moment / weight_ - mean * mean, 0.0));
  }

  /// Standard deviation that noise gives the centre. The noise of so many samples on end is alike.
  double noise_sd_s() const {
    const int alike = series_.correlated_samples();
    double moved = 0.0, squares = 0.0;
    for (int k = first_; k < end_; k += kRun) {
      const int count = std::min(kRun, end_ - k);
      alignas(64) Column comes, goes;
      moved_by(k, count, comes);
      const int without = std::clamp(first_ + alike - k, 0, count);  // samples before which none goes
      moved_by(k - alike + without, count - without, goes);
      for (int i = 0; i < count; ++i) {
        moved += comes[static_cast<std::size_t>(i)] - (i < without ? 0.0 : goes[static_cast<std::size_t>(i - without)]);
        squares += moved * moved;
      }
    }
    return std::sqrt(squares / alike) / weight_;
  }

 private:
  void weigh() {
    for (int k = first_; k < end_; k += kRun) {
      const int count = std::min(kRun, end_ - k);
      alignas(64) Column whole, ratio_squared;
      at(k, count, [&](std::size_t i, double t, double power, double gain) {
        const double ratio = t / middle_s_;
        ratio_squared[i] = ratio * ratio;
        whole[i] = (power - noise_) * gain;
      });
      inverse_square_ += sum_of(whole, count);
      for (int i = 0; i < count; ++i) whole[static_cast<std::size_t>(i)] *= ratio_squared[static_cast<std::size_t>(i)];
      weight_ += sum_of(whole, count);
    }
  }

  /// use(i, time, power, gain by absorption) for samples from k on, kRun at most.
  template <class Use>
  void at(int k, int count, const Use& use) const {
    const float* const amplitude_upa = series_.amplitude_upa.data() + k;
    const double start_s = series_.start_s, period_s = series_.period_s, half_pulse_s = 0.5 * series_.pulse_length_s;
    for (int i = 0; i < count; ++i) {
      const double t = start_s + (k + i) * period_s - half_pulse_s, a = static_cast<double>(amplitude_upa[i]);
      const auto gain = static_cast<double>(fast_math::exp2(static_cast<float>(loss_per_s_ * (t - middle_s_))));
      use(static_cast<std::size_t>(i), t, a * a, gain);
    }
  }

  /// How much each sample's noise moves the first moment: the variance of |s + n|^2 given |s|^2 is
  /// 2 |s|^2 <n^2> + <n^2>^2 for complex Gaussian noise n.
  void moved_by(int k, int count, Column& moved) const {
    at(k, count, [&](std::size_t i, double t, double power, double gain) {
      const double ratio = t / middle_s_, above = power - noise_, signal = above > 0.0 ? above : 0.0;
      moved[i] = gain * ratio * ratio * (t - middle_s_) * std::sqrt(noise_ * (2.0 * signal + noise_));
    });
  }

  const BeamSeries& series_;
  double middle_s_, noise_, loss_per_s_;  // loss in powers of two
  int first_, end_;
  double inverse_square_ = 0.0;  // sum of the weights ...
  double weight_ = 0.0;          // ... and of these times (time / middle)^2
};

}  // namespace

Estimate centre_of_gravity(const BeamSeries& series, const ExpectedSeabed& seabed, double near_s, double noise_power,
                           double loss_np_ps) {
  double centre_s = near_s, spread_s = 0.0, noise_sd_s = 0.0;
  for (int pass = 1; pass <= kPasses; ++pass) {
    const Window window(series, centre_s, gravity_window_s(series, seabed, centre_s), noise_power, loss_np_ps);
    if (!window.found()) return {};
    centre_s = window.centre_s();
    if (pass < kPasses) continue;
    spread_s = window.spread_s();
    noise_sd_s = window.noise_sd_s();
  }

  // Speckle moves the centre by spread / sqrt(number of independent samples). A pulse alone has the spread of a box of
  // its length and does not move; the power of a boxcar pulse's speckle is correlated as (1 - |dt| / pulse)^2, whose
  // integral is 2/3 of the pulse; and a box of standard deviation s is s sqrt(12) long.
  const double pulse = series.pulse_length_s;
  const double spread = std::sqrt(std::max(spread_s * spread_s - pulse * pulse / 12.0, 0.0));
  const double independent = 1.0 + spread * std::sqrt(12.0) / (2.0 / 3.0 * pulse);
  const double sampling = series.period_s / std::sqrt(12.0);
  return {true, centre_s, std::sqrt(spread * spread / independent + noise_sd_s * noise_sd_s + sampling * sampling)};
}

}  // namespace ensonify::detect
