#include "components/sonar/tone_shape.h"

#include "components/config/config_reader.h"

namespace ensonify {

void check_taper(const ConfigReader& from, bool chirp, double tapered_fraction) {
  if (chirp && tapered_fraction != 0.0) from.problem("tapered_fraction", "is of tones; chirps have a window");
}

void fill_shape(bool chirp, double tapered_fraction, msg::AppliedSettings& applied) {
  applied.pulse = chirp ? "fm_up" : (tapered_fraction > 0.0 ? "cw_tapered" : "cw");
  applied.tapered_fraction = tapered_fraction;
}

}  // namespace ensonify
