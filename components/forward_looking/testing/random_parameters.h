#pragma once

#include "components/forward_looking/node.h"
#include "components/sonar/testing/random_head.h"

namespace ensonify {

template <>
struct RandomParameters<ForwardLookingNode> {
  static std::string yaml(Draws& draw) {
    return fmt::format(
               "frequency_hz: {}\nbeams: {}\naperture_deg: {}\nbeamwidth_deg: {}\ntransmit_vertical_deg: {}\n"
               "receive_vertical_deg: {}\ntilt_deg: {}\nsamples_per_pulse: {}\nmost_samples: {}\n"
               "source_level_db: {}\nrange_m: {}\nconverter:\n  bits: {}\nquality: 0.05\n",
               draw.scale(50e3, 3e6), draw.whole(16, 64), draw.between(10, 160), draw.scale(1, 10), draw.scale(1, 90),
               draw.scale(1, 90), draw.between(-90, 90), draw.between(2, 20), draw.whole(64, 300),
               draw.between(-300, 250), draw.scale(0.5, 40), draw.yes() ? 0 : draw.whole(1, 16)) +
           random_pulse(draw, "").yaml + shading_yaml(draw, "shading") + lod_yaml(draw) + effects_yaml(draw);
  }
};

}  // namespace ensonify
