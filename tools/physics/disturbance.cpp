#include "kernels/vehicle/motion/disturbance.h"

#include <memory>
#include <numbers>

#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

struct Inputs {
  std::string_view preset = motion::kDisturbancePresets[0];
  double seed = 1.0;
  double t_s = 0.0;
};

}  // namespace

void add_disturbance(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(app, "disturbance",
                                  "a vessel's irregular motion about its mean pose, by presets: six axes at a time");
  const auto in = std::make_shared<Inputs>();
  std::vector<std::pair<std::string, std::string_view>> presets;
  for (const std::string_view name : motion::kDisturbancePresets) presets.emplace_back(std::string(name), name);
  verb.choice("preset", in->preset, presets, "whose motion");
  verb.number("seed", in->seed, 0, 1e9, "another motion with the same statistics; a whole number");
  verb.number("t_s", in->t_s, 0, 1e6, "time");
  verb.results({"surge_m", "sway_m", "heave_m", "roll_deg", "pitch_deg", "heading_deg"}, [in] {
    const random::Stream stream(static_cast<std::uint64_t>(in->seed), "physics/disturbance");
    const auto off = motion::Disturbance(*motion::disturbance_preset(in->preset), stream).at(in->t_s);
    constexpr double kDegree = std::numbers::pi / 180.0;
    return Verb::Row{off.surge_m.value,
                     off.sway_m.value,
                     off.heave_m.value,
                     off.roll_rad.value / kDegree,
                     off.pitch_rad.value / kDegree,
                     off.heading_rad.value / kDegree};
  });
}

}  // namespace ensonify::physics
