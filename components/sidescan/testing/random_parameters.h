#pragma once

#include "components/sidescan/node.h"
#include "components/sonar/testing/random_head.h"

namespace ensonify {

template <>
struct RandomParameters<SidescanNode> {
  static std::string yaml(Draws& draw) {
    const char* const focuses[] = {"echo", "off", "fixed\n    focus_m: 10"};
    const std::string line =
        draw.yes() ? shading_yaml(draw, "shading") : fmt::format("focus: {}\n", focuses[draw.whole(0, 2)]);
    std::string yaml = fmt::format(
        "channels:\n  - name: main\n    frequency_hz: {}\n    horizontal_beamwidth_deg: {}\n"
        "    vertical_beamwidth_deg: {}\n    depression_deg: {}\n    back_loss_db: {}\n    source_level_db: {}\n"
        "    range_m: {}\n    samples_per_pulse: {}\n    {}",
        draw.scale(50e3, 1e6), draw.scale(0.05, 10), draw.between(5, 150), draw.between(0, 90), draw.between(0, 100),
        draw.between(-300, 250), draw.scale(1, 40), draw.between(2, 6), line);
    yaml += random_pulse(draw, "    ").yaml;
    yaml += fmt::format("converter:\n  bits: {}\nquality: 0.1\n", draw.yes() ? 0 : draw.whole(1, 16));
    return yaml + lod_yaml(draw) + effects_yaml(draw);
  }
};

}  // namespace ensonify
