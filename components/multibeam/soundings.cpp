#include "components/multibeam/soundings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/multibeam/arrays.h"
#include "components/multibeam/placing.h"
#include "components/runtime/head/environment.h"
#include "kernels/array/line.h"

namespace ensonify {
namespace {

/// Entries of a beam without a sounding are NaN, so that no sum, bound or picture takes it for a measurement.
template <class T>
msg::Array<T> nothing(std::vector<std::size_t> shape) {
  msg::Array<T> array(std::move(shape));
  std::ranges::fill(array.flat(), std::numeric_limits<T>::quiet_NaN());
  return array;
}

/// As many entries as beams, none of which says anything yet.
msg::Soundings without_entries(std::size_t beams) {
  msg::Soundings soundings;
  soundings.travel_time_s = nothing<float>({beams});
  soundings.backscatter_db = nothing<float>({beams});
  soundings.backscatter_strength_db = nothing<float>({beams});
  soundings.quality_db = nothing<float>({beams});
  soundings.range_sd_m = nothing<float>({beams});
  soundings.angle_sd_rad = nothing<float>({beams});
  soundings.window_s = nothing<float>({beams});
  soundings.kind = msg::Array<std::uint8_t>({beams});
  soundings.flags = msg::Array<std::uint8_t>({beams});
  soundings.valid = msg::Array<std::uint8_t>({beams});
  soundings.position_enu_m = nothing<double>({beams, 3});
  return soundings;
}

std::uint8_t flags_of(const detect::Detection& detection) {
  const auto bit = [&](unsigned from, msg::SoundingFlag to) {
    return (detection.flags & from) != 0 ? unsigned{to} : 0U;
  };
  return static_cast<std::uint8_t>(bit(detect::kNoSignal | detect::kLowSnr, msg::kWeak) |
                                   bit(detect::kCutOff, msg::kCutOff) | bit(detect::kOutOfGate, msg::kOutOfGate));
}

/// Angle in the plane across the track between the head's z axis and the vertical: where a level seabed lies for it.
double seabed_tilt_rad(const frames::HeadPose& head) {
  const frames::Vec3 down = head.enu_from_head.conjugate() * -frames::Vec3::UnitZ();
  return std::atan2(down.y(), down.z());
}

}  // namespace

SoundingMaker::SoundingMaker(const MultibeamConfig& config)
    : config_(config),
      applied_(applied_profile(config.world)),
      transmit_length_in_waves_(array::length_in_waves_for(config.transmit_beamwidth_rad)) {
  settings_.pulse_length_s = config.pulse_length_s;
  settings_.gates.snr_db = config.detection_threshold_db;
  const double depth_m = config.world.mission.depth_m;
  settings_.absorption_dbpm = Environment(config.world, config.frequency_hz).absorption_dbpm(depth_m, depth_m);
  const ReceiveLine line = receive_line(config);
  settings_.receive_length_in_waves = array::length_in_waves_for(config.receive_beamwidth_rad);
  settings_.phase_centres_in_waves = line.halves.baseline_m / line.wavelength_m;
}

frames::HeadPose SoundingMaker::believed_pose(const frames::PoseHistory& estimate, SimTime t) const {
  return frames::head_pose(*estimate.at(t.count(), frames::PoseHistory::Outside::kNearest), config_.mounting.measured);
}

msg::Soundings SoundingMaker::make(const Shot& shot, const Steering& steering, const MultibeamHead::Heard& heard,
                                   const frames::PoseHistory& estimate) {
  settings_.sound_speed_mps = steering.sound_speed_mps;
  settings_.seabed_tilt_rad = estimate.empty() ? 0.0 : seabed_tilt_rad(believed_pose(estimate, shot.transmit));
  detect::detect_bottom(settings_, steering.sin_beams, heard.image, heard.halves, detections_);

  msg::Soundings soundings = without_entries(steering.sin_beams.size());
  soundings.stamp_ns = shot.transmit.count();
  soundings.ping = shot.ping;
  soundings.sample_period_s = heard.image.period_s;
  soundings.beam_angle_rad = msg::Array<float>::of(steering.beam_angle_rad);
  flag(steering, soundings);
  heard_.clear();
  if (estimate.empty()) return soundings;
  for (std::size_t beam = 0; beam < detections_.size(); ++beam) {
    if ((detections_[beam].flags & detect::kNoSignal) == 0) soundings.quality_db[beam] = detections_[beam].snr_db;
    if (soundings.flags[beam] != 0) continue;
    measure(steering.sound_speed_mps, beam, heard.image.period_s, soundings);
    place(shot, steering, estimate, beam, soundings);
  }
  return soundings;
}

/// Why beams give no sounding. Outward of a beam whose echo is cut off by the range, what a beam hears are the side
/// lobes of those within it.
void SoundingMaker::flag(const Steering& steering, msg::Soundings& soundings) const {
  for (std::size_t beam = 0; beam < detections_.size(); ++beam) soundings.flags[beam] = flags_of(detections_[beam]);
  const auto outward = [&](std::ptrdiff_t first, std::ptrdiff_t step) {
    bool cut_off = false;
    const auto end = static_cast<std::ptrdiff_t>(detections_.size());
    for (std::ptrdiff_t i = first; i >= 0 && i < end; i += step) {
      const auto beam = static_cast<std::size_t>(i);
      if (cut_off) soundings.flags[beam] |= msg::kSideLobe;
      cut_off = cut_off || (detections_[beam].flags & detect::kCutOff) != 0;
    }
  };
  const auto middle = std::ranges::lower_bound(steering.sin_beams, 0.0F) - steering.sin_beams.begin();
  outward(middle, 1);
  outward(middle - 1, -1);
}

void SoundingMaker::measure(double sound_speed_mps, std::size_t beam, double sample_period_s,
                            msg::Soundings& soundings) const {
  const detect::Detection& detection = detections_[beam];
  const double level_db = detection.echo_energy_db - 10.0 * std::log10(config_.pulse_length_s);
  const double range_m = 0.5 * detection.two_way_s * sound_speed_mps;
  const double area_m2 = detect::beam_area_m2(range_m, std::sin(static_cast<double>(soundings.beam_angle_rad[beam])),
                                              transmit_length_in_waves_, settings_.receive_length_in_waves);
  soundings.travel_time_s[beam] = static_cast<float>(detection.two_way_s);
  soundings.backscatter_db[beam] = static_cast<float>(level_db);
  soundings.backscatter_strength_db[beam] =
      static_cast<float>(level_db - config_.source_level_db + 40.0 * std::log10(range_m) +
                         2.0 * settings_.absorption_dbpm * range_m - 10.0 * std::log10(area_m2));
  soundings.range_sd_m[beam] = detection.range_sd_m;
  soundings.angle_sd_rad[beam] = detection.angle_sd_rad;
  soundings.window_s[beam] = static_cast<float>(detection.snippet_count * sample_period_s);
  soundings.kind[beam] = detection.phase_weight > 0.5F ? 2 : 1;
}

void SoundingMaker::place(const Shot& shot, const Steering& steering, const frames::PoseHistory& estimate,
                          std::size_t beam, msg::Soundings& soundings) {
  const double two_way_s = detections_[beam].two_way_s;
  const frames::Vec3 place = sounding_enu_m(
      {believed_pose(estimate, shot.transmit), believed_pose(estimate, shot.transmit + from_seconds(two_way_s)),
       steering.sin_transmit, steering.sin_beams[beam], steering.sound_speed_mps, two_way_s},
      applied_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    soundings.position_enu_m(beam, axis) = place[static_cast<Eigen::Index>(axis)];
  }
  soundings.valid[beam] = 1;
  heard_.push_back({steering.across_rad[beam], 0.5 * two_way_s * steering.sound_speed_mps});
}

}  // namespace ensonify
