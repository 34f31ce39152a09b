#include "components/multibeam/steering.h"

#include <algorithm>
#include <cmath>

#include "kernels/acoustics/array/beam_layout.h"
#include "kernels/acoustics/array/stabilisation.h"

namespace ensonify {
namespace {

using Spacing = MultibeamConfig::Spacing;

/// Angles at which beams are formed and soundings are sought.
array::HighDensity layout_of(const MultibeamConfig& c, double swath_rad) {
  const double half = 0.5 * swath_rad;
  if (c.spacing == Spacing::kHighDensity) {
    return array::high_density_beams(-half, half, c.beams, c.soundings == 0 ? 2 * c.beams : c.soundings);
  }
  array::HighDensity layout;
  layout.beam_rad = c.spacing == Spacing::kEquiangle ? array::equiangular_beams_rad(half, c.beams)
                                                     : array::equidistant_beams_rad(half, c.beams);
  layout.sounding_rad = layout.beam_rad;
  for (int beam = 0; beam < c.beams; ++beam) layout.beam_of_sounding.push_back(beam);
  return layout;
}

constexpr double kMostYaw_rad = 10.0 * MultibeamConfig::kDegree;  // assumed: beyond it fans are held no further

/// From the head to the frame in which angles are counted, by what is estimated.
frames::Quaternion held_from_head(const MultibeamConfig& config, const SteeringInputs& inputs) {
  if (!inputs.vehicle) return frames::Quaternion::Identity();
  const frames::Attitude head =
      frames::attitude_of(frames::enu_from_body(*inputs.vehicle) * config.mounting.measured.body_from_head);
  const double heading_rad = inputs.vehicle->heading_rad;
  const double yaw_rad = frames::wrap_pi(heading_rad - inputs.mean_heading_rad);
  const bool follows = std::abs(yaw_rad) <= kMostYaw_rad;
  const double reference_rad = follows ? inputs.mean_heading_rad : heading_rad - std::copysign(kMostYaw_rad, yaw_rad);
  return array::held_from_head({config.pitch_stabilised, config.yaw_stabilised, config.roll_stabilised}, head,
                               reference_rad + head.heading_rad - heading_rad);
}

/// Sine to steer to for a direction at an angle on the cone of a sector's fan.
float across_sine(const frames::Quaternion& held, double sin_transmit, double across_rad) {
  const auto on_fan = array::fan_direction(held, sin_transmit, across_rad);
  const frames::Vec3 direction = held.conjugate() * on_fan.value_or(array::direction_held(across_rad));
  return static_cast<float>(direction.z() > 0.0 ? direction.y() : std::copysign(1.0, direction.y()));
}

float arcsine(float sine) { return std::asin(std::clamp(sine, -1.0F, 1.0F)); }

SteeredSector steered(const frames::Quaternion& held, const array::TransmitSector& sector) {
  const frames::Vec3 direction = array::direction_held(sector.centre_rad, sector.tilt_rad);
  const frames::Vec3 middle = held.conjugate() * direction;
  SteeredSector steered;
  steered.sin_transmit = array::transmit_sine(held, direction);
  steered.middle_rad = std::atan2(middle.y(), middle.z());
  return steered;
}

}  // namespace

std::vector<array::TransmitSector> sectors_of(const MultibeamConfig& config, double swath_rad) {
  const auto all = config.all_sectors();
  double shares = 0.0;
  for (const auto& sector : all) shares += sector.share;
  std::vector<array::TransmitSector> sectors;
  double lower_rad = -0.5 * swath_rad;
  for (const auto& sector : all) {
    const double width_rad = swath_rad * sector.share / shares;
    sectors.push_back({.centre_rad = lower_rad + 0.5 * width_rad,
                       .width_rad = width_rad,
                       .tilt_rad = sector.tilt_rad,
                       .frequency_hz = sector.frequency_hz,
                       .delay_s = sector.delay_s});
    lower_rad += width_rad;
  }
  return sectors;
}

Steering steer(const MultibeamConfig& config, double swath_rad, const SteeringInputs& inputs) {
  Steering steering;
  steering.sound_speed_mps = inputs.sound_speed_mps;
  steering.roll_stabilised = config.roll_stabilised && inputs.vehicle.has_value();
  steering.pitch_stabilised = config.pitch_stabilised && inputs.vehicle.has_value();
  steering.yaw_stabilised = config.yaw_stabilised && inputs.vehicle.has_value();

  const frames::Quaternion held = held_from_head(config, inputs);
  const auto sectors = sectors_of(config, swath_rad);
  for (std::size_t i = 0; i < sectors.size(); ++i) {
    SteeredSector sector = steered(held, sectors[i]);
    if (i > 0) sector.lower_sine = across_sine(held, sector.sin_transmit, sectors[i].lower_rad());
    if (i + 1 < sectors.size()) sector.upper_sine = across_sine(held, sector.sin_transmit, sectors[i].upper_rad());
    steering.sectors.push_back(sector);
  }

  const array::HighDensity layout = layout_of(config, swath_rad);
  for (const float across : layout.beam_rad) {
    const auto nearest = array::sector_of(sectors, static_cast<double>(across));
    // Rounding may put the outermost beams beyond the swath.
    const std::size_t sector = nearest.value_or(across < 0.0F ? 0 : sectors.size() - 1);
    SteeredSector& of_beam = steering.sectors[sector];
    if (of_beam.beams++ == 0) of_beam.first_beam = static_cast<int>(steering.sin_beams.size());
    steering.beam_sector.push_back(static_cast<std::uint8_t>(sector));
    steering.sin_beams.push_back(across_sine(held, of_beam.sin_transmit, static_cast<double>(across)));
    steering.beam_angle_rad.push_back(arcsine(steering.sin_beams.back()));
  }
  steering.across_rad = layout.sounding_rad;
  steering.beam_of_sounding = layout.beam_of_sounding;
  for (std::size_t i = 0; i < layout.sounding_rad.size(); ++i) {
    const auto beam = static_cast<std::size_t>(layout.beam_of_sounding[i]);
    const double sin_transmit = steering.sectors[steering.beam_sector[beam]].sin_transmit;
    steering.sin_soundings.push_back(across_sine(held, sin_transmit, static_cast<double>(layout.sounding_rad[i])));
    steering.sounding_angle_rad.push_back(arcsine(steering.sin_soundings.back()));
  }
  return steering;
}

}  // namespace ensonify
