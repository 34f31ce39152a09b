#pragma once

#include "components/multibeam/node.h"
#include "components/sonar/testing/random_head.h"

namespace ensonify {

template <>
struct RandomParameters<MultibeamNode> {
  static std::string yaml(Draws& draw) {
    const RandomPulse pulse = random_pulse(draw, "");
    const char* const spacings[] = {"equiangle", "equidistant", "high_density"};
    std::string yaml = fmt::format(
        "frequency_hz: {}\nbeams: {}\nswath_deg: {}\nspacing: {}\ntransmit_beamwidth_deg: {}\nreceive_beamwidth_deg: "
        "{}\n"
        "sample_rate_hz: {}\nsource_level_db: {}\nauto_range: {}\nrange_m: {}\nquality: 0.05\n",
        draw.scale(50e3, 1e6), draw.whole(2, 100), draw.between(1, 170), spacings[draw.whole(0, 2)],
        draw.scale(0.5, 20), draw.scale(0.5, 20), draw.between(2.0, 4.0) * pulse.band_hz, draw.between(-300, 250),
        draw.yes(), draw.scale(1, 40));
    yaml += pulse.yaml + lod_yaml(draw);
    yaml += fmt::format(
        "detections_per_beam: {}\nback_loss_db: {}\nconverter:\n  bits: {}\nphase_every: {}\nsnippets: {}\n"
        "seabed_image:\n  published: true\nleast_range_m: {}\n",
        draw.yes() ? 1 : draw.whole(2, 8), draw.between(0, 100), draw.yes() ? 0 : draw.whole(1, 16), draw.whole(0, 2),
        draw.yes(), draw.between(0, 4));
    if (draw.yes()) {
      yaml += "sectors:\n";
      for (int i = draw.whole(1, 4); i > 0; --i) {
        yaml += fmt::format("  - {{ share: {}, frequency_hz: {}, tilt_deg: {}, delay_s: {} }}\n", draw.scale(0.05, 20),
                            draw.scale(50e3, 1e6), draw.between(-20, 20), draw.between(0, 0.01));
      }
    }
    return yaml + shading_yaml(draw, "transmit_shading") + shading_yaml(draw, "receive_shading") + effects_yaml(draw);
  }
};

}  // namespace ensonify
