#include "components/multibeam/soundings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/multibeam/placing.h"
#include "components/runtime/head/environment.h"
#include "kernels/array/line.h"

namespace ensonify {

SoundingMaker::SoundingMaker(const MultibeamConfig& config) : config_(config), applied_(applied_profile(config.world)) {
  settings_.pulse_length_s = config.pulse_length_s;
  settings_.gates.snr_db = config.detection_threshold_db;
  const double depth_m = config.world.mission.depth_m;
  settings_.absorption_dbpm = Environment(config.world, config.frequency_hz).absorption_dbpm(depth_m, depth_m);
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

msg::Soundings SoundingMaker::make(const Shot& shot, const Steering& steering, const detect::Amplitudes& image,
                                   const frames::PoseHistory& estimate) {
  settings_.sound_speed_mps = steering.sound_speed_mps;
  detect::detect_bottom(settings_, steering.sin_beams, image, detections_);
  const std::size_t beams = steering.sin_beams.size();
  msg::Soundings soundings;
  soundings.stamp_ns = shot.transmit.count();
  soundings.ping = shot.ping;
  soundings.beam_angle_rad = msg::Array<float>::of(steering.beam_angle_rad);
  soundings.travel_time_s = nothing<float>({beams});
  soundings.backscatter_db = nothing<float>({beams});
  soundings.quality_db = nothing<float>({beams});
  soundings.valid = msg::Array<std::uint8_t>({beams});
  soundings.position_enu_m = nothing<double>({beams, 3});
  heard_.clear();
  drop_beyond_range(steering);
  if (estimate.empty()) return soundings;
  for (std::size_t beam = 0; beam < beams; ++beam) {
    if (detections_[beam].valid) place(shot, steering, estimate, beam, soundings);
  }
  return soundings;
}

/// Outward of a beam whose echo is cut off by the range, what a beam hears are the sidelobes of those within it.
void SoundingMaker::drop_beyond_range(const Steering& steering) {
  const auto drop_outward = [&](std::ptrdiff_t first, std::ptrdiff_t step) {
    bool cut_off = false;
    const auto end = static_cast<std::ptrdiff_t>(detections_.size());
    for (std::ptrdiff_t i = first; i >= 0 && i < end; i += step) {
      const auto beam = static_cast<std::size_t>(i);
      cut_off = cut_off || (detections_[beam].flags & detect::kCutOff) != 0;
      if (cut_off) detections_[beam].valid = false;
    }
  };
  const auto middle = std::ranges::lower_bound(steering.sin_beams, 0.0F) - steering.sin_beams.begin();
  drop_outward(middle, 1);
  drop_outward(middle - 1, -1);
}

void SoundingMaker::place(const Shot& shot, const Steering& steering, const frames::PoseHistory& estimate,
                          std::size_t beam, msg::Soundings& soundings) {
  const detect::Detection& detection = detections_[beam];
  const auto pose_at = [&](SimTime t) {
    return frames::head_pose(*estimate.at(t.count(), frames::PoseHistory::Outside::kNearest),
                             config_.mounting.measured);
  };
  const frames::Vec3 place =
      sounding_enu_m({pose_at(shot.transmit), pose_at(shot.transmit + from_seconds(detection.two_way_s)), 0.0,
                      steering.sin_beams[beam], steering.sound_speed_mps, detection.two_way_s},
                     applied_);
  soundings.travel_time_s[beam] = static_cast<float>(detection.two_way_s);
  soundings.backscatter_db[beam] =
      detection.echo_energy_db - static_cast<float>(10.0 * std::log10(config_.pulse_length_s));
  soundings.quality_db[beam] = detection.snr_db;
  soundings.valid[beam] = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    soundings.position_enu_m(beam, axis) = place[static_cast<Eigen::Index>(axis)];
  }
  heard_.push_back({steering.beam_angle_rad[beam], 0.5 * detection.two_way_s * steering.sound_speed_mps});
}

}  // namespace ensonify
