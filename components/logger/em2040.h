#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "messages/sonar.h"

/// What files say of a head as of an EM 2040, in either of its formats.
namespace ensonify::logger {

/// Of its three frequencies, 200, 300 and 400 kHz, the nearest: 0, 1, 2.
inline int frequency_index(double frequency_hz) {
  if (frequency_hz < 250e3) return 0;
  return frequency_hz < 350e3 ? 1 : 2;
}

inline bool is_chirp(const std::string& pulse) { return pulse.starts_with("fm"); }

/// 0 CW, 1 FM up, 2 FM down.
inline std::uint8_t waveform_of(const std::string& pulse) {
  if (!is_chirp(pulse)) return 0;
  return pulse == "fm_down" ? 2 : 1;
}

/// What a chirp sweeps; of a tone, one over its length.
inline double bandwidth_hz(const msg::TransmitSector& sector) {
  return sector.bandwidth_hz > 0.0 ? sector.bandwidth_hz : 1.0 / std::max(sector.pulse_length_s, 1e-6);
}

}  // namespace ensonify::logger
