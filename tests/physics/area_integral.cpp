#include "tests/physics/area_integral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::physics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kFewestRings = 6;    // in a pulse
constexpr double kPerLobe = 0.25;  // steps of sine, lambda / L: the two-way pattern has no finer detail than 0.5
constexpr int kFewestSteps = 64;

/// What comes back from the ring of slant range R, per metre of it.
double ring_upa2pm(const LevelSeabed& seabed, const Tone& tone, double R) {
  const double down = seabed.altitude_m / R, level = std::sqrt(1.0 - down * down);
  const int steps = std::max(kFewestSteps, static_cast<int>(2.0 * kPi * level / (kPerLobe * tone.finest_sine)));
  double received = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double psi = 2.0 * kPi * i / steps;
    received += tone.pattern(level * std::cos(psi), level * std::sin(psi), down);
  }
  const double source = std::pow(10.0, 0.1 * tone.source_level_db);
  const double absorbed = std::pow(10.0, -0.2 * seabed.absorption_dbpm * R);
  return source * seabed.backscatter(std::asin(down)) * absorbed * std::pow(R, -3) * received * 2.0 * kPi / steps;
}

}  // namespace

double mean_square_upa2(const LevelSeabed& seabed, const Tone& tone, double time_s) {
  const double half_c = 0.5 * seabed.sound_speed_mps, H = seabed.altitude_m;
  const double from = std::max(H, half_c * (time_s - tone.pulse_length_s)), to = half_c * time_s;
  if (to <= from) return 0.0;
  // Rings evenly apart on the ground, rho, where R dR = rho drho: near nadir a beam's echo comes within millimetres.
  const double inner = std::sqrt(from * from - H * H), outer = std::sqrt(to * to - H * H);
  const int rings = std::max(kFewestRings, static_cast<int>((outer - inner) / (kPerLobe * tone.finest_sine * H)));
  const double step = (outer - inner) / rings;
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double rho = inner + (i + 0.5) * step, R = std::hypot(rho, H);
    sum += ring_upa2pm(seabed, tone, R) * rho / R * step;
  }
  return sum;
}

double elements_power(int elements, double spacing_in_waves, double sine, double sin_steer) {
  const double x = kPi * spacing_in_waves * (sine - sin_steer), under = elements * std::sin(x);
  return std::abs(under) < 1e-9 ? 1.0 : std::pow(std::sin(elements * x) / under, 2);
}

double db(double ratio) { return 10.0 * std::log10(ratio); }

}  // namespace ensonify::physics
