#include "kernels/acoustics/sea_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "kernels/seabed/backscatter.h"

namespace ensonify::surface {
namespace {

using std::numbers::pi;

constexpr double kDegree = pi / 180.0;
constexpr double kLeastGrazing = 0.001 * kDegree;
constexpr double kGravity = 9.80665;

/// Bubbles: f in kHz, U in m/s.
double bubble_cross_section(double sine, double f, double U) {
  const double gentle = std::pow(10.0, -5.2577 + 0.4701 * std::min(U, 11.0)) * std::pow(f / 25.0, 0.85);
  const double beta_v = U < 11.0 ? gentle : gentle * std::pow(U / 11.0, 3.5);
  const double beta = beta_v / sine;  // absorbed on the slanted way through the layer
  const double radiation = 0.0136;    // damping constants: by re-radiation, and in total
  const double damping = 0.0255 * std::cbrt(f);
  // 1 - exp(-4 beta) without cancellation in calm water, where beta is small.
  return beta_v / (4.0 * pi) * (radiation / damping) * (8.0 * beta * std::exp(-2.0 * beta) - std::expm1(-4.0 * beta)) /
         (2.0 * beta);
}

/// Grazing angle where the facets' lobe is 15 dB below its peak.
double facets_end(double slope_squared) {
  const double fall = 1.5 * std::numbers::ln10;
  double tan_squared = fall * slope_squared;
  for (int i = 0; i < 20; ++i) tan_squared = slope_squared * (fall + 2.0 * std::log1p(tan_squared));  // contracts
  return pi / 2.0 - std::atan(std::sqrt(tan_squared));
}

/// Two-way loss in dB: f in kHz, U in m/s.
double bubble_loss_db(double sine, double f, double U) {
  const double windy = 1.26e-3 * std::pow(std::max(U, 6.0), 1.57) * std::pow(f, 0.85) / sine;
  return U < 6.0 ? windy * std::exp(1.2 * (U - 6.0)) : windy;
}

}  // namespace

double mean_square_slope(double wind_speed_mps) {
  return wind_speed_mps < 1.0 ? 0.0034 : 0.0046 * std::log(2.1 * wind_speed_mps * wind_speed_mps);
}

SurfaceBackscatter sea_surface_backscatter(double grazing_rad, double frequency_hz, double wind_speed_mps) {
  if (!(frequency_hz > 0.0)) {
    throw std::invalid_argument("frequency " + std::to_string(frequency_hz) + " Hz: allowed is above 0");
  }
  if (!(wind_speed_mps >= 0.0)) {
    throw std::invalid_argument("wind speed " + std::to_string(wind_speed_mps) + " m/s: allowed is 0 or more");
  }
  const double theta = std::clamp(grazing_rad, kLeastGrazing, pi / 2.0);
  const double sine = std::sin(theta);
  const double f = frequency_hz * 1e-3;
  const double U = wind_speed_mps;
  const double slope_squared = mean_square_slope(U);

  SurfaceBackscatter part;
  part.bubbles = bubble_cross_section(sine, f, U);
  part.facets = seabed::facet_backscatter(sine, slope_squared);
  part.ripples = 1.3e-5 * U * U * std::pow(std::tan(std::min(theta, 85.0 * kDegree)), 4);
  const double degrees_below = (facets_end(slope_squared) - theta) / kDegree;
  const double facets_share = 1.0 / (1.0 + std::exp(0.524 * degrees_below));
  part.interface = facets_share * part.facets + (1.0 - facets_share) * part.ripples;
  part.bubble_loss_db = bubble_loss_db(sine, f, U);
  part.total = part.interface * std::pow(10.0, -0.1 * part.bubble_loss_db) + part.bubbles;
  return part;
}

double coherent_reflection(double wavenumber_radpm, double rms_height_m, double grazing_rad) {
  const double roughness = wavenumber_radpm * rms_height_m * std::sin(grazing_rad);
  return -std::exp(-2.0 * roughness * roughness);
}

double rms_wave_height_m(double wind_speed_mps) { return 0.25 * 0.2092 * wind_speed_mps * wind_speed_mps / kGravity; }

}  // namespace ensonify::surface
