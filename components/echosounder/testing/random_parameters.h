#pragma once

#include "components/echosounder/node.h"
#include "components/sonar/testing/random_head.h"

namespace ensonify {

template <>
struct RandomParameters<EchosounderNode> {
  static std::string yaml(Draws& draw) {
    return fmt::format(
               "frequency_hz: {}\nface: {}\nbeamwidth_deg: {}\nsource_level_db: {}\npulse_length_s: {}\nrange_m: {}\n"
               "samples_per_pulse: {}\nleast_range_m: {}\nconverter:\n  bits: {}\n",
               draw.scale(20e3, 1e6), draw.yes() ? "circular" : "square", draw.scale(0.5, 40), draw.between(-300, 250),
               draw.scale(2e-5, 1e-3), draw.scale(1, 40), draw.between(2, 20), draw.between(1, 4),
               draw.yes() ? 0 : draw.whole(1, 16)) +
           effects_yaml(draw);
  }
};

}  // namespace ensonify
