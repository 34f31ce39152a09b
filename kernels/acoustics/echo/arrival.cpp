#include "kernels/acoustics/echo/arrival.h"

#include <cmath>
#include <numbers>

#include "kernels/acoustics/echo/run.h"

namespace ensonify::echo {

std::complex<float> echo_pressure(const Carrier& carrier, double mean_square_upa2, double time_s,
                                  std::complex<float> response) {
  if (carrier.sum == Sum::kMeanSquare) return {static_cast<float>(mean_square_upa2), 0.0F};
  const double cycles = carrier.frequency_hz * time_s;
  const auto angle = static_cast<float>(-2.0 * std::numbers::pi * (cycles - std::floor(cycles)));
  const std::complex<float> phasor(std::cos(angle), std::sin(angle));
  const auto amplitude = static_cast<float>(std::sqrt(mean_square_upa2));
  const std::complex<float> turned(phasor.real() * response.real() - phasor.imag() * response.imag(),
                                   phasor.real() * response.imag() + phasor.imag() * response.real());
  return amplitude * turned;
}

void add_direct_echoes(const Carrier& carrier, const frames::Vec3& source_enu_m, const Scatterers& scatterers,
                       const Receivers& receivers, Arrivals& arrivals) {
  const std::size_t before = arrivals.size();
  arrivals.resize(before + scatterers.size());
  for_runs(carrier, receivers, source_enu_m, scatterers, [&](Run& run, std::size_t) {
    run.direct({arrivals, before + run.first()});
  });
}

}  // namespace ensonify::echo
