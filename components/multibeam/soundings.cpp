#include "components/multibeam/soundings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/multibeam/geometry.h"
#include "kernels/array/line.h"

namespace ensonify {

SoundingMaker::SoundingMaker(const MultibeamConfig& config, std::vector<float> beam_angle_rad)
    : config_(config), beam_angle_rad_(std::move(beam_angle_rad)) {
  for (const float angle : beam_angle_rad_) sin_beams_.push_back(std::sin(angle));
  settings_.pulse_length_s = config.pulse_length_s;
  settings_.gates.snr_db = config.detection_threshold_db;
  settings_.sound_speed_mps = config.known_sound_speed_mps();
  settings_.absorption_dbpm = config.absorption_dbpm;
  settings_.receive_length_in_waves = array::length_in_waves_for(config.receive_beamwidth_rad);
}

namespace {

/// Entries of a beam without a sounding are NaN, so that no sum, bound or picture takes it for a measurement.
template <class T>
msg::Array<T> nothing(std::vector<std::size_t> shape) {
  msg::Array<T> array(std::move(shape));
  std::ranges::fill(array.flat(), std::numeric_limits<T>::quiet_NaN());
  return array;
}

}  // namespace

msg::Soundings SoundingMaker::make(const Shot& shot, const detect::Amplitudes& image,
                                   const frames::PoseHistory& estimate) {
  detect::detect_bottom(settings_, sin_beams_, image, detections_);
  const std::size_t beams = sin_beams_.size();
  msg::Soundings soundings;
  soundings.stamp_ns = shot.transmit.count();
  soundings.ping = shot.ping;
  soundings.beam_angle_rad = msg::Array<float>::of(beam_angle_rad_);
  soundings.travel_time_s = nothing<float>({beams});
  soundings.backscatter_db = nothing<float>({beams});
  soundings.quality_db = nothing<float>({beams});
  soundings.valid = msg::Array<std::uint8_t>({beams});
  soundings.position_enu_m = nothing<double>({beams, 3});
  heard_.clear();
  drop_beyond_range();
  if (estimate.empty()) return soundings;
  for (std::size_t beam = 0; beam < beams; ++beam) {
    if (detections_[beam].valid) place(shot, estimate, beam, soundings);
  }
  return soundings;
}

/// Outward of a beam whose echo is cut off by the range, what a beam hears are the sidelobes of those within it.
void SoundingMaker::drop_beyond_range() {
  const auto drop_outward = [&](std::ptrdiff_t first, std::ptrdiff_t step) {
    bool cut_off = false;
    const auto end = static_cast<std::ptrdiff_t>(detections_.size());
    for (std::ptrdiff_t i = first; i >= 0 && i < end; i += step) {
      const auto beam = static_cast<std::size_t>(i);
      cut_off = cut_off || (detections_[beam].flags & detect::kCutOff) != 0;
      if (cut_off) detections_[beam].valid = false;
    }
  };
  const auto middle = std::lower_bound(sin_beams_.begin(), sin_beams_.end(), 0.0F) - sin_beams_.begin();
  drop_outward(middle, 1);
  drop_outward(middle - 1, -1);
}

void SoundingMaker::place(const Shot& shot, const frames::PoseHistory& estimate, std::size_t beam,
                          msg::Soundings& soundings) {
  const detect::Detection& detection = detections_[beam];
  const auto pose_at = [&](SimTime t) {
    return frames::head_pose(*estimate.at(t.count(), frames::PoseHistory::Outside::kNearest),
                             config_.mounting.measured);
  };
  const frames::Vec3 place =
      sounding_enu_m(pose_at(shot.transmit), pose_at(shot.transmit + from_seconds(detection.two_way_s)),
                     sin_beams_[beam], detection.two_way_s, config_.known_sound_speed_mps());
  soundings.travel_time_s[beam] = static_cast<float>(detection.two_way_s);
  soundings.backscatter_db[beam] =
      detection.echo_energy_db - static_cast<float>(10.0 * std::log10(config_.pulse_length_s));
  soundings.quality_db[beam] = detection.snr_db;
  soundings.valid[beam] = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    soundings.position_enu_m(beam, axis) = place[static_cast<Eigen::Index>(axis)];
  }
  heard_.push_back({beam_angle_rad_[beam], 0.5 * detection.two_way_s * config_.known_sound_speed_mps()});
}

}  // namespace ensonify
