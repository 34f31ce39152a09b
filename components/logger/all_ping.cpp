#include "components/logger/all_ping.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/logger/beam_fields.h"
#include "components/logger/em2040.h"
#include "components/logger/head_track.h"

namespace ensonify::logger {

using namespace formats::all;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::uint16_t window_samples(const msg::Soundings& soundings, std::size_t i) {
  return count_of(at_or_nan(soundings.window_s, i) / soundings.sample_period_s);
}

/// 2500 times the standard deviation of the range over the range, rounded up: 0 would say that there is none.
std::uint8_t quality_of(const msg::Soundings& soundings, std::size_t i) {
  const double range_m = 0.5 * at_or_nan(soundings.travel_time_s, i) * soundings.applied.sound_speed_mps;
  return static_cast<std::uint8_t>(
      std::min<std::uint16_t>(count_of(std::ceil(2500.0 * at_or_nan(soundings.range_sd_m, i) / range_m)), 254));
}

RawRangeAngle::Sector sector_of(const msg::TransmitSector& sent, double absorption_dbpm) {
  constexpr std::uint8_t kCentreArray = 1;  // of an EM 2040's three
  RawRangeAngle::Sector sector;
  sector.tilt_deg = sector.tilt_deg.of(sent.tilt_rad / kDegree);
  sector.focus_m = sector.focus_m.of(sent.focus_range_m);
  sector.pulse_length_s = static_cast<float>(sent.pulse_length_s);
  sector.delay_s = static_cast<float>(sent.delay_s);
  sector.centre_hz = static_cast<float>(sent.frequency_hz);
  sector.absorption_dbpkm = sector.absorption_dbpkm.of(1e3 * absorption_dbpm);
  sector.waveform = waveform_of(sent.pulse);
  sector.index = kCentreArray;
  sector.bandwidth_hz = static_cast<float>(bandwidth_hz(sent));
  return sector;
}

}  // namespace

RawRangeAngle raw_range_angle(const msg::Soundings& soundings) {
  RawRangeAngle raw;
  raw.sound_speed_mps = raw.sound_speed_mps.of(soundings.applied.sound_speed_mps);
  raw.valid_beams = valid_beams(soundings);
  raw.sampling_hz = sampling_hz(soundings.sample_period_s);
  for (const msg::TransmitSector& sector : sectors_of(soundings.applied)) {
    raw.sectors.push_back(sector_of(sector, soundings.applied.gain_absorption_dbpm));
  }
  for (std::size_t i = 0; i < soundings.beam_angle_rad.size(); ++i) {
    RawRangeAngle::Beam beam;
    beam.angle_deg = beam.angle_deg.of(-static_cast<double>(soundings.beam_angle_rad[i]) / kDegree);  // to port
    if (i < soundings.sector.size()) beam.sector = soundings.sector[i];
    beam.detection = detection_of(soundings, i);
    if (is_valid(soundings, i)) {
      beam.window_samples = window_samples(soundings, i);
      beam.quality = quality_of(soundings, i);
      beam.travel_time_s = soundings.travel_time_s[i];
      beam.reflectivity_db = beam.reflectivity_db.of(at_or_nan(soundings.backscatter_strength_db, i));
    }
    raw.beams.push_back(beam);
  }
  return raw;
}

Soundings xyz(const msg::Soundings& soundings, const Vessel& vessel, const frames::LocalProjection& world,
              double heave_down_m) {
  const frames::Pose body = body_pose_of(soundings.track, vessel);
  const frames::Vec3 head_enu_m = frames::enu_from_body(body, vessel.head.position_body_m);
  const frames::Vec3 origin_enu_m = vessel.horizontal_origin_enu_m(body);
  const double grid_heading_rad = frames::attitude_of(body.enu_from_body).heading_rad;
  const double sine = std::sin(grid_heading_rad), cosine = std::cos(grid_heading_rad);
  const double convergence_rad = world.convergence_rad(body.position_enu_m.head<2>());

  Soundings xyz;
  xyz.heading_deg = xyz.heading_deg.of(frames::wrap_two_pi(grid_heading_rad + convergence_rad) / kDegree);
  xyz.sound_speed_mps = xyz.sound_speed_mps.of(soundings.applied.sound_speed_mps);
  xyz.transducer_depth_m = static_cast<float>(vessel.transducer_depth_m(body, heave_down_m));
  xyz.valid_beams = valid_beams(soundings);
  xyz.sampling_hz = sampling_hz(soundings.sample_period_s);
  for (std::size_t i = 0; i < soundings.beam_angle_rad.size(); ++i) {
    Soundings::Beam beam;
    beam.detection = detection_of(soundings, i);
    if (is_valid(soundings, i)) {
      const double east_m = soundings.position_enu_m(i, 0) - origin_enu_m.x();
      const double north_m = soundings.position_enu_m(i, 1) - origin_enu_m.y();
      beam.x_m = static_cast<float>(east_m * sine + north_m * cosine);
      beam.y_m = static_cast<float>(east_m * cosine - north_m * sine);
      beam.z_m = static_cast<float>(head_enu_m.z() - soundings.position_enu_m(i, 2));
      beam.window_samples = window_samples(soundings, i);
      beam.quality = quality_of(soundings, i);
      beam.reflectivity_db = beam.reflectivity_db.of(at_or_nan(soundings.backscatter_strength_db, i));
    }
    xyz.beams.push_back(beam);
  }
  return xyz;
}

}  // namespace ensonify::logger
