#include "components/multibeam/soundings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/sonar/environment.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/base/profile/profile.h"
#include "kernels/survey/georeference/two_way.h"

namespace ensonify {

using frames::Vec3;

namespace {

constexpr double kLeastCosine = 0.1;  // of angles from the vertical and from the array's normal: 84 degrees

/// Entries without a sounding are NaN, so that no sum, bound or picture takes them for a measurement.
template <class T>
msg::Array<T> nothing(std::vector<std::size_t> shape) {
  msg::Array<T> array(std::move(shape));
  std::ranges::fill(array.flat(), std::numeric_limits<T>::quiet_NaN());
  return array;
}

/// So many entries, none of which says anything yet.
msg::Soundings without_measurements(std::size_t entries) {
  msg::Soundings soundings;
  soundings.travel_time_s = nothing<float>({entries});
  soundings.backscatter_db = nothing<float>({entries});
  soundings.backscatter_strength_db = nothing<float>({entries});
  soundings.quality_db = nothing<float>({entries});
  soundings.range_sd_m = nothing<float>({entries});
  soundings.angle_sd_rad = nothing<float>({entries});
  soundings.window_s = nothing<float>({entries});
  soundings.kind = msg::Array<std::uint8_t>({entries});
  soundings.flags = msg::Array<std::uint8_t>({entries});
  soundings.valid = msg::Array<std::uint8_t>({entries});
  soundings.position_enu_m = nothing<double>({entries, 3});
  soundings.tvu_m = nothing<float>({entries});
  soundings.thu_m = nothing<float>({entries});
  return soundings;
}

template <class T, class Member>
msg::Array<T> of_each(const std::vector<Echo>& echoes, Member member) {
  std::vector<T> values;
  for (const Echo& echo : echoes) values.push_back(static_cast<T>(echo.*member));
  return msg::Array<T>::of(values);
}

std::uint8_t flags_of(const detect::Detection& detection) {
  const auto bit = [&](unsigned from, msg::SoundingFlag to) {
    return (detection.flags & from) != 0 ? unsigned{to} : 0U;
  };
  return static_cast<std::uint8_t>(bit(detect::kNoSignal | detect::kLowSnr, msg::kWeak) |
                                   bit(detect::kCutOff, msg::kCutOff) | bit(detect::kOutOfGate, msg::kOutOfGate));
}

}  // namespace

SoundingMaker::SoundingMaker(const MultibeamConfig& config, const ArrayDesign& arrays)
    : config_(config), applied_(applied_profile(*config.world)), sectors_(arrays.sectors) {}

Placed SoundingMaker::place(const InstrumentPing& ping, Detected detected, ReliefEstimator& relief,
                            Memory& memory) const {
  const profile::Span span(profile::Stage::kPlacing);
  const Steering& steering = ping.steering;
  Placed placed{.echoes = std::move(detected.echoes), .soundings = {}, .bottoms = {}};
  const std::vector<Echo>& echoes = placed.echoes;
  msg::Soundings& soundings = placed.soundings;
  soundings = without_measurements(echoes.size());
  soundings.stamp_ns = ping.event.transmit.count();
  soundings.ping = ping.event.ping;
  soundings.sample_period_s = detected.sample_period_s;
  std::vector<float> angle_rad;
  for (const Echo& echo : echoes) {
    angle_rad.push_back(steering.sounding_angle_rad[static_cast<std::size_t>(echo.place)]);
  }
  soundings.beam_angle_rad = msg::Array<float>::of(angle_rad);
  if (steering.high_density() || config_.detections_per_beam > 1) {
    soundings.beam = of_each<std::uint16_t>(echoes, &Echo::beam);
  }
  if (config_.detections_per_beam > 1) soundings.detection = of_each<std::uint8_t>(echoes, &Echo::detection);
  if (sectors_.size() > 1) soundings.sector = of_each<std::uint8_t>(echoes, &Echo::sector);
  flag(steering, placed);
  if (ping.estimate.empty()) return placed;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const detect::Detection& found = echoes[i].measured;
    if ((found.flags & detect::kNoSignal) == 0) soundings.quality_db[i] = found.snr_db;
    if (soundings.flags[i] != 0) continue;
    measure(ping, i, detected.echo_s, placed);
    place(ping, i, placed);
  }
  const uncertainty::Geometry geometry = motion(ping);
  const frames::Vec3 head_enu_m = ping.head_pose(config_.mounting.measured, ping.event.transmit).position_enu_m;
  update(relief, geometry, head_enu_m, placed, memory);
  state_uncertainty(ping, geometry, head_enu_m, relief, placed);
  return placed;
}

/// How the head lies and moves at transmission, by the estimate: over 0.2 s, longer than the noise of attitudes and
/// shorter than waves.
uncertainty::Geometry SoundingMaker::motion(const InstrumentPing& ping) const {
  constexpr double kSpan_s = 0.2;
  const auto body_at = [&](SimTime t) { return *ping.estimate.at(t.count(), frames::PoseHistory::Outside::kNearest); };
  const frames::Pose now = body_at(ping.event.transmit), before = body_at(ping.event.transmit - from_seconds(kSpan_s));
  const frames::HeadPose head = frames::head_pose(now, config_.mounting.measured);
  const frames::Quaternion turn = now.enu_from_body * before.enu_from_body.conjugate();
  uncertainty::Geometry motion;
  motion.lever_enu_m = head.position_enu_m - now.position_enu_m;
  motion.enu_from_head = head.enu_from_head;
  motion.velocity_enu_mps = (now.position_enu_m - before.position_enu_m) / kSpan_s;
  motion.rate_enu_radps = (turn.w() < 0.0 ? -2.0 : 2.0) / kSpan_s * turn.vec();  // a small turn
  motion.sound_speed_mps = ping.steering.sound_speed_mps;
  return motion;
}

SoundingMaker::Footprint SoundingMaker::footprint(std::size_t entry, const frames::Vec3& away_enu_m,
                                                  const Placed& placed) const {
  const SectorDesign& sector = sectors_[static_cast<std::size_t>(placed.echoes[entry].sector)];
  const double range_m = away_enu_m.norm();
  const double cos_vertical = std::max(-away_enu_m.z() / range_m, kLeastCosine);
  const double cos_beam = std::max(std::cos(static_cast<double>(placed.soundings.beam_angle_rad[entry])), kLeastCosine);
  const double receive_width = 2.0 * array::half_power_half_width(sector.receive_in_waves);  // sine
  const double transmit_width =
      2.0 * std::sin(0.5 * config_.transmit_beamwidth_rad) * config_.frequency_hz / sector.frequency_hz;  // sine
  return {range_m * receive_width / (cos_vertical * cos_beam), range_m * transmit_width};
}

/// Heights' noise is that of the detection.
void SoundingMaker::update(ReliefEstimator& relief, const uncertainty::Geometry& motion, const frames::Vec3& head_enu_m,
                           const Placed& placed, Memory& memory) const {
  const msg::Soundings& soundings = placed.soundings;
  const frames::Vec3 starboard = motion.enu_from_head * frames::Vec3::UnitY();
  const frames::Vec3 across_enu = frames::Vec3(starboard.x(), starboard.y(), 0.0).normalized();
  std::vector<ReliefEstimator::Sounding>& profile = memory.profile;
  profile.clear();
  for (std::size_t i = 0; i < placed.echoes.size(); ++i) {
    const Echo& echo = placed.echoes[i];
    if (soundings.valid[i] == 0 || (!profile.empty() && profile.back().place == echo.place)) continue;
    const frames::Vec3 away(soundings.position_enu_m(i, 0) - head_enu_m.x(),
                            soundings.position_enu_m(i, 1) - head_enu_m.y(),
                            soundings.position_enu_m(i, 2) - head_enu_m.z());
    const double range_m = away.norm(), cos_vertical = std::max(-away.z() / range_m, kLeastCosine);
    const double tan_vertical = std::sqrt(1.0 - cos_vertical * cos_vertical) / cos_vertical;
    const double along_ray_m = std::hypot(soundings.range_sd_m[i], range_m * tan_vertical * soundings.angle_sd_rad[i]);
    profile.push_back(
        {echo.place,
         {away.dot(across_enu), away.z(), footprint(i, away, placed).across_m, along_ray_m * cos_vertical}});
  }
  relief.take(profile);
}

void SoundingMaker::state_uncertainty(const InstrumentPing& ping, const uncertainty::Geometry& motion,
                                      const frames::Vec3& head, const ReliefEstimator& relief, Placed& placed) const {
  msg::Soundings& soundings = placed.soundings;
  uncertainty::Geometry geometry = motion;
  for (std::size_t i = 0; i < placed.echoes.size(); ++i) {
    if (soundings.valid[i] == 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      geometry.away_enu_m[k] = soundings.position_enu_m(i, axis) - head[k];
    }
    const Footprint on_seabed = footprint(i, geometry.away_enu_m, placed);
    const double relief_sd_m =
        relief.sd_m(placed.echoes[i].place, on_seabed.across_m, on_seabed.along_m / on_seabed.across_m);
    const uncertainty::Matrix3 covariance_enu_m2 =
        uncertainty::covariance_enu_m2(geometry, {soundings.range_sd_m[i], soundings.angle_sd_rad[i], relief_sd_m},
                                       ping.navigation, config_.uncertainty.sources);
    soundings.tvu_m[i] = static_cast<float>(uncertainty::tvu_m(covariance_enu_m2));
    soundings.thu_m[i] = static_cast<float>(uncertainty::thu_m(covariance_enu_m2));
  }
}

/// Why there are entries without a sounding. Outward of a beam whose echo is cut off by the range, what a beam receives
/// are the side lobes of those within it.
void SoundingMaker::flag(const Steering& steering, Placed& placed) {
  const std::vector<Echo>& echoes = placed.echoes;
  msg::Soundings& soundings = placed.soundings;
  for (std::size_t i = 0; i < echoes.size(); ++i) soundings.flags[i] = flags_of(echoes[i].measured);
  const auto sine = [&](const Echo& echo) { return steering.sin_soundings[static_cast<std::size_t>(echo.place)]; };
  const auto middle = std::ranges::lower_bound(echoes, 0.0F, {}, sine) - echoes.begin();
  const auto outward = [&](std::ptrdiff_t from, std::ptrdiff_t step) {
    const auto end = static_cast<std::ptrdiff_t>(echoes.size());
    int cut_off_at = -1;  // place
    for (std::ptrdiff_t i = from; i >= 0 && i < end; i += step) {
      const Echo& echo = echoes[static_cast<std::size_t>(i)];
      if (cut_off_at >= 0 && echo.place != cut_off_at) soundings.flags[static_cast<std::size_t>(i)] |= msg::kSideLobe;
      if (cut_off_at < 0 && (echo.measured.flags & detect::kCutOff) != 0) cut_off_at = echo.place;
    }
  };
  outward(middle, 1);
  outward(middle - 1, -1);
}

void SoundingMaker::measure(const InstrumentPing& ping, std::size_t entry, double pulse_length_s,
                            Placed& placed) const {
  const Echo& echo = placed.echoes[entry];
  const detect::Detection& detection = echo.measured;
  const SectorDesign& sector = sectors_[static_cast<std::size_t>(echo.sector)];
  msg::Soundings& soundings = placed.soundings;
  const HeadSettings& settings = ping.settings;
  const double level_db = detection.echo_energy_db - 10.0 * std::log10(pulse_length_s);
  const double range_m = 0.5 * detection.two_way_s * ping.steering.sound_speed_mps;
  const double area_m2 = detect::beam_area_m2(range_m, std::sin(static_cast<double>(soundings.beam_angle_rad[entry])),
                                              sector.area.transmit_in_waves, sector.area.receive_in_waves);
  soundings.travel_time_s[entry] = static_cast<float>(detection.two_way_s);
  soundings.backscatter_db[entry] = static_cast<float>(level_db);
  soundings.backscatter_strength_db[entry] =
      static_cast<float>(level_db - settings.source_level_db + 40.0 * std::log10(range_m) +
                         2.0 * settings.gain_absorption_dbpm * range_m - 10.0 * std::log10(area_m2));
  soundings.range_sd_m[entry] = detection.range_sd_m;
  soundings.angle_sd_rad[entry] = detection.angle_sd_rad;
  soundings.window_s[entry] = static_cast<float>(detection.snippet_count * soundings.sample_period_s);
  soundings.kind[entry] = detection.phase_weight > 0.5F ? 2 : 1;
}

void SoundingMaker::place(const InstrumentPing& ping, std::size_t entry, Placed& placed) const {
  const Echo& echo = placed.echoes[entry];
  const Steering& steering = ping.steering;
  const auto sector = static_cast<std::size_t>(echo.sector), place = static_cast<std::size_t>(echo.place);
  const SimTime transmit = ping.event.transmit + from_seconds(sectors_[sector].delay_s);
  const double two_way_s = echo.measured.two_way_s;
  const frames::Vec3 where = georeference::sounding_enu_m(
      {ping.head_pose(config_.mounting.measured, transmit),
       ping.head_pose(config_.mounting.measured, transmit + from_seconds(two_way_s)),
       steering.sectors[sector].sin_transmit, static_cast<double>(steering.sin_soundings[place]),
       steering.sound_speed_mps, two_way_s},
      applied_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    placed.soundings.position_enu_m(entry, axis) = where[static_cast<Eigen::Index>(axis)];
  }
  placed.soundings.valid[entry] = 1;
  placed.bottoms.push_back(
      {static_cast<double>(steering.across_rad[place]), 0.5 * two_way_s * steering.sound_speed_mps});
}

}  // namespace ensonify
