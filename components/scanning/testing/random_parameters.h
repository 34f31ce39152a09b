#pragma once

#include "components/scanning/node.h"
#include "components/sonar/testing/random_head.h"

namespace ensonify {

template <>
struct RandomParameters<ScanningNode> {
  static std::string yaml(Draws& draw) {
    return fmt::format(
               "frequency_hz: {}\nhorizontal_beamwidth_deg: {}\nvertical_beamwidth_deg: {}\ntilt_deg: {}\n"
               "sector_centre_deg: {}\npulse_length_s: {}\nmost_samples: {}\nsource_level_db: {}\nrange_m: {}\n"
               "converter:\n  bits: {}\nquality: 0.05\n",
               draw.scale(50e3, 3e6), draw.scale(0.5, 20), draw.scale(0.5, 90), draw.between(-90, 90),
               draw.between(-180, 180), draw.scale(2e-5, 1e-3), draw.whole(64, 300), draw.between(-300, 250),
               draw.scale(0.5, 40), draw.yes() ? 0 : draw.whole(1, 16)) +
           shading_yaml(draw, "shading") + effects_yaml(draw);
  }
};

}  // namespace ensonify
