#include "components/multibeam/arrays.h"

namespace ensonify {
namespace {

// Instruments shade their receive lines, and say little of how. With a uniform line the outermost beams hear the
// nadir's echo through its side lobes louder than their own in some 60 m of water.
constexpr array::Shading kReceiveShading{array::Shading::Window::kTaylor, 30.0, 4};

}  // namespace

ReceiveLine receive_line(const MultibeamConfig& config) {
  ReceiveLine line;
  line.wavelength_m = config.sound_speed_mps / config.frequency_hz;
  line.whole = array::line_array_of_width(config.receive_beamwidth_rad, line.wavelength_m, kReceiveShading);
  line.halves = array::split_aperture(line.whole);
  return line;
}

}  // namespace ensonify
