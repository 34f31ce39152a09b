#include "kernels/echo/interference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::echo {

double band_overlap(const ForeignTransmission& foreign, const ReceiverBand& band) {
  const double low =
      std::max(foreign.frequency_hz - 0.5 * foreign.bandwidth_hz, band.frequency_hz - 0.5 * band.bandwidth_hz);
  const double high =
      std::min(foreign.frequency_hz + 0.5 * foreign.bandwidth_hz, band.frequency_hz + 0.5 * band.bandwidth_hz);
  const double inside = std::max(0.0, high - low) / std::max(foreign.bandwidth_hz, 1e-9);
  return std::min(1.0, inside + std::pow(10.0, -0.1 * band.rejection_db));
}

void add_interference(std::span<const ForeignTransmission> transmissions, const ReceiverBand& band, const Pulse& pulse,
                      std::vector<Arrival>& arrivals) {
  const double length_s = pulse.equivalent_length_s();
  for (const ForeignTransmission& foreign : transmissions) {
    const double path_m = std::max(foreign.path_m, 0.1);
    const double level_db =
        foreign.source_level_db - foreign.spreading_db * std::log10(path_m) - band.absorption_dbpm * path_m;
    const double amplitude = std::sqrt(std::pow(10.0, 0.1 * level_db) * band_overlap(foreign, band));
    const int pulses = std::max(1, static_cast<int>(std::lround(foreign.duration_s / length_s)));
    const double first_s = foreign.time_s + path_m / band.sound_speed_mps;
    for (int i = 0; i < pulses; ++i) {
      const double time_s = first_s + i * length_s;
      // Our mixer turns it at the difference of frequencies; it left at phase 0 of its own.
      const double cycles = (foreign.frequency_hz - band.frequency_hz) * time_s - foreign.frequency_hz * first_s;
      const double angle = 2.0 * std::numbers::pi * (cycles - std::floor(cycles));
      arrivals.push_back({time_s, std::complex<float>(std::polar(amplitude, angle)), foreign.direction_head});
    }
  }
}

}  // namespace ensonify::echo
