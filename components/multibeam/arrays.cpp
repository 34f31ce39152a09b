#include "components/multibeam/arrays.h"

namespace ensonify {

ReceiveLine receive_line(const MultibeamConfig& config) {
  ReceiveLine line;
  line.wavelength_m = config.sound_speed_mps / config.frequency_hz;
  line.whole = array::line_array_of_width(config.receive_beamwidth_rad, line.wavelength_m);
  line.halves = array::split_aperture(line.whole);
  return line;
}

}  // namespace ensonify
