#include "kernels/vehicle/motion/disturbance_presets.h"

#include <numbers>

namespace ensonify::motion {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

DisturbanceParameters research_ship() {
  DisturbanceParameters p;
  p.heave = {.oscillation_sd = 1.12, .period_s = 10.7, .jitter = 0.24, .coherence = 1.0};
  p.roll = {.oscillation_sd = 0.58 * kDegree, .period_s = 12.8, .jitter = 0.2, .coherence = 0.54};
  p.pitch = {.oscillation_sd = 1.86 * kDegree,
             .period_s = 9.1,
             .jitter = 0.25,
             .coherence = 0.87,
             .lead_rad = 0.5 * std::numbers::pi};
  p.heading = {.oscillation_sd = 0.5 * kDegree, .period_s = 11.3, .wander_sd = 0.43 * kDegree, .hurst = 0.7};
  return p;
}

DisturbanceParameters survey_launch() {
  DisturbanceParameters p;
  p.heave = {.oscillation_sd = 0.03, .period_s = 3.5, .coherence = 1.0};
  p.roll = {.oscillation_sd = 1.65 * kDegree, .period_s = 4.0, .coherence = 0.5, .wander_sd = 0.41 * kDegree};
  p.pitch = {.oscillation_sd = 0.79 * kDegree, .period_s = 3.0, .coherence = 0.8, .wander_sd = 0.13 * kDegree};
  p.heading = {.oscillation_sd = 0.5 * kDegree, .period_s = 5.0, .wander_sd = 1.0 * kDegree, .hurst = 0.6};
  return p;
}

DisturbanceParameters auv() {
  DisturbanceParameters p;
  p.heave = {.wander_sd = 0.03, .hurst = 0.6, .return_s = 20};
  p.sway = {.wander_sd = 0.05, .hurst = 0.6, .return_s = 20};
  p.roll = {.oscillation_sd = 0.8 * kDegree, .period_s = 3.0, .wander_sd = 0.5 * kDegree};
  p.pitch = {.oscillation_sd = 0.4 * kDegree, .period_s = 4.0, .wander_sd = 0.3 * kDegree};
  p.heading = {.wander_sd = 0.7 * kDegree, .hurst = 0.6};
  return p;
}

}  // namespace

std::optional<DisturbanceParameters> disturbance_preset(std::string_view name) {
  if (name == "research_ship") return research_ship();
  if (name == "survey_launch") return survey_launch();
  if (name == "auv") return auv();
  return std::nullopt;
}

}  // namespace ensonify::motion
