#include "components/sonar/effects.h"

#include "components/config/config_reader.h"

namespace ensonify {

void read_quality(ConfigReader& from, double& quality) { from.optional("quality", quality, 0.05, 10); }

void read_effects(ConfigReader& from, Effects& effects) {
  auto section = from.optional_section("effects");
  if (!section) return;
  section->optional("refraction", effects.refraction);
  section->optional("absorption", effects.absorption);
  section->optional("directivity", effects.directivity);
  section->optional("side_lobes", effects.side_lobes);
  section->optional("speckle", effects.speckle);
  section->optional("noise", effects.noise);
  section->optional("volume", effects.volume);
  section->optional("multipath", effects.multipath);
  section->optional("interference", effects.interference);
  section->optional("motion", effects.motion);
  section->optional("tvg", effects.tvg);
  section->optional("quantisation", effects.quantisation);
}

}  // namespace ensonify
