#pragma once

#include <optional>

#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"
#include "kernels/survey/uncertainty/sounding.h"

namespace ensonify {

/// What surrounds a head when it transmits and when its ping is computed: for the acoustics the vehicle's true poses
/// and the seabed, for the instrument its own estimates. In a node the head's inputs.
struct Surroundings {
  const frames::PoseHistory& truth;
  const trace::Scene& seabed;
  // As the instrument knows them.
  const frames::PoseHistory& estimate;
  const std::optional<uncertainty::Navigation>& navigation_errors;  // that the newest estimate states
  double sound_speed_mps = 1500.0;                                  // of the probe, or what the head starts with
  std::optional<double> probe_mps = std::nullopt;
};

}  // namespace ensonify
