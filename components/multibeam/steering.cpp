#include "components/multibeam/steering.h"

#include <algorithm>
#include <cmath>

#include "kernels/array/beam_layout.h"
#include "kernels/array/stabilisation.h"

namespace ensonify {
namespace {

std::vector<float> layout_of(const MultibeamConfig& c) {
  return c.spacing == MultibeamConfig::Spacing::kEquiangle ? array::equiangular_beams_rad(0.5 * c.swath_rad, c.beams)
                                                           : array::equidistant_beams_rad(0.5 * c.swath_rad, c.beams);
}

/// From the head to the frame in which angles are counted, by what is believed.
frames::Quaternion held_from_head(const MultibeamConfig& config, const Belief& belief) {
  if (!belief.vehicle) return frames::Quaternion::Identity();
  const frames::Attitude head =
      frames::attitude_of(frames::enu_from_body(*belief.vehicle) * config.mounting.measured.body_from_head);
  return array::held_from_head({config.pitch_stabilised, false, config.roll_stabilised}, head, 0.0);
}

}  // namespace

Steering steer(const MultibeamConfig& config, const Belief& belief) {
  Steering steering;
  steering.sound_speed_mps = belief.sound_speed_mps;
  steering.roll_stabilised = config.roll_stabilised && belief.vehicle.has_value();
  steering.pitch_stabilised = config.pitch_stabilised && belief.vehicle.has_value();
  steering.across_rad = layout_of(config);

  const frames::Quaternion held = held_from_head(config, belief);
  const frames::Vec3 middle = held.conjugate() * array::direction_held(0.0);
  steering.sin_transmit = array::transmit_sine(held, array::direction_held(0.0));
  steering.middle_rad = std::atan2(middle.y(), middle.z());
  for (const float across : steering.across_rad) {
    const auto on_fan = array::fan_direction(held, steering.sin_transmit, across);
    const frames::Vec3 direction = held.conjugate() * on_fan.value_or(array::direction_held(across));
    const double sine = direction.z() > 0.0 ? direction.y() : std::copysign(1.0, direction.y());
    steering.sin_beams.push_back(static_cast<float>(sine));
    steering.beam_angle_rad.push_back(static_cast<float>(std::asin(std::clamp(sine, -1.0, 1.0))));
  }
  return steering;
}

}  // namespace ensonify
