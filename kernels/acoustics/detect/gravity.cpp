#include "kernels/acoustics/detect/gravity.h"

namespace ensonify::detect {
namespace {

struct Centre {
  bool found = false;
  double two_way_s = 0.0;
  double spread_s = 0.0;    // standard deviation of the power about it
  double noise_sd_s = 0.0;  // what noise does to it
};

Centre centre_in(const BeamSeries& series, double middle_s, double half_window_s, double noise, double loss_np_ps) {
  const int end = series.index_from(middle_s + half_window_s);
  double weight = 0.0, inverse_square = 0.0, first_moment = 0.0, second_moment = 0.0, noise_moment = 0.0;
  for (int k = series.index_from(middle_s - half_window_s); k < end; ++k) {
    const double t = series.echo_s(k);
    if (t <= 0.0) continue;
    const double ratio = t / middle_s;
    const double gain = ratio * ratio * std::exp(loss_np_ps * (t - middle_s));
    const double w = (series.power(k) - noise) * gain;
    weight += w;
    inverse_square += w / (ratio * ratio);
    first_moment += w * (t - middle_s);
    second_moment += w * (t - middle_s) * (t - middle_s);
    // The variance of |s + n|^2 given |s|^2 is 2 |s|^2 <n^2> + <n^2>^2 for complex Gaussian noise n.
    noise_moment +=
        gain * gain * noise * (2.0 * std::max(series.power(k) - noise, 0.0) + noise) * (t - middle_s) * (t - middle_s);
  }
  if (!(weight > 0.0) || !(inverse_square > 0.0)) return {};
  const double mean = first_moment / weight;
  return {true, middle_s * std::sqrt(weight / inverse_square),
          std::sqrt(std::max(second_moment / weight - mean * mean, 0.0)), std::sqrt(noise_moment) / weight};
}

}  // namespace

double gravity_window_s(const BeamSeries& series, const ExpectedSeabed& seabed, double two_way_s) {
  return seabed.footprint_s(two_way_s) + series.pulse_length_s;
}

Estimate centre_of_gravity(const BeamSeries& series, const ExpectedSeabed& seabed, double near_s, double noise_power,
                           double loss_np_ps) {
  Centre centre{true, near_s, 0.0, 0.0};
  for (int pass = 0; pass < 4 && centre.found; ++pass) {
    centre = centre_in(series, centre.two_way_s, gravity_window_s(series, seabed, centre.two_way_s), noise_power,
                       loss_np_ps);
  }
  if (!centre.found) return {};

  // Speckle moves the centre by spread / sqrt(number of independent samples). A pulse alone has the spread of a box of
  // its length and does not move; the power of a boxcar pulse's speckle is correlated as (1 - |dt| / pulse)^2, whose
  // integral is 2/3 of the pulse; and a box of standard deviation s is s sqrt(12) long.
  const double pulse = series.pulse_length_s;
  const double spread = std::sqrt(std::max(centre.spread_s * centre.spread_s - pulse * pulse / 12.0, 0.0));
  const double independent = 1.0 + spread * std::sqrt(12.0) / (2.0 / 3.0 * pulse);
  const double sampling = series.period_s / std::sqrt(12.0);
  return {true, centre.two_way_s,
          std::sqrt(spread * spread / independent + centre.noise_sd_s * centre.noise_sd_s + sampling * sampling)};
}

}  // namespace ensonify::detect
