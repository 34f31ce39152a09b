#include "components/logger/kmall/ping_info.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/logger/beam_fields.h"
#include "components/logger/em2040.h"

namespace ensonify::logger::kmall {

using namespace formats::kmall;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Of the envelope between its half powers: raised cosines reach them at 0.636 of their rise.
double effective_s(const msg::AppliedSettings& settings, double pulse_length_s) {
  constexpr double kHalfPower = 0.636;
  return pulse_length_s * (1.0 - kHalfPower * settings.tapered_fraction);
}

/// 1 where the beams' angles are apart alike, else 0: their places are.
std::uint8_t spacing_of(const msg::Array<float>& angle_rad) {
  constexpr float kAlike = 1.05F;
  if (angle_rad.size() < 3) return 1;
  const std::size_t last = angle_rad.size() - 1, middle = last / 2;
  const float edge = angle_rad[last] - angle_rad[last - 1], nadir = angle_rad[middle + 1] - angle_rad[middle];
  return edge < nadir * kAlike && nadir < edge * kAlike ? 1 : 0;
}

/// As far as valid soundings reach on either side.
void add_coverage(std::span<const Sounding> soundings, PingInfo& info) {
  float port_m = 0.0F, starboard_m = 0.0F;
  for (const Sounding& one : soundings) {
    if (!one.valid()) continue;
    const auto angle_deg = static_cast<float>(std::atan2(-one.y_m, one.z_m) / kDegree);
    info.port_coverage_deg = std::max(info.port_coverage_deg, angle_deg);
    info.starboard_coverage_deg = std::min(info.starboard_coverage_deg, angle_deg);
    port_m = std::min(port_m, one.y_m);
    starboard_m = std::max(starboard_m, one.y_m);
  }
  info.port_coverage_m = static_cast<std::int16_t>(std::clamp(std::round(port_m), -32'767.0F, 0.0F));
  info.starboard_coverage_m = static_cast<std::int16_t>(std::clamp(std::round(starboard_m), 0.0F, 32'767.0F));
}

}  // namespace

PingPose ping_pose(const LoggedSoundings& ping, const Vessel& vessel, const PingPlace& place) {
  constexpr std::uint8_t kInterpolated = 1;
  const frames::Vec3 to_all_m =
      place.level_from_enu * (vessel.horizontal_origin_enu_m(place.body) - place.body.position_enu_m);
  PingPose pose;
  pose.heading_deg = static_cast<float>(place.heading_deg);
  pose.sound_speed_mps = static_cast<float>(ping.soundings.applied.sound_speed_mps);
  pose.transducer_depth_m = static_cast<float>(vessel.transducer_depth_m(place.body, ping.heave_down_m));
  pose.water_line_m = static_cast<float>(vessel.water_line_m - ping.heave_down_m);
  pose.x_to_all_m = static_cast<float>(to_all_m.x());
  pose.y_to_all_m = static_cast<float>(to_all_m.y());
  pose.position_info = kInterpolated;
  pose.latitude_deg = place.reference.latitude_deg;
  pose.longitude_deg = place.reference.longitude_deg;
  return pose;
}

PingInfo ping_info(const msg::Soundings& soundings, std::span<const Sounding> written) {
  constexpr std::uint8_t kShallowByHand = 101, kChirp = 2;
  constexpr std::uint8_t kPitchStabilised = 1, kYawStabilised = 2;
  constexpr std::uint16_t kNormalGate = 1, kNormalPhaseRamp = 1 << 12;
  const msg::AppliedSettings& applied = soundings.applied;
  const float edge_deg = static_cast<float>(0.5 * applied.swath_rad / kDegree);
  PingInfo info;
  info.ping_rate_hz = static_cast<float>(applied.ping_rate_hz);
  info.beam_spacing = spacing_of(soundings.beam_angle_rad);
  info.depth_mode = kShallowByHand;
  info.pulse_form = is_chirp(applied.pulse) ? kChirp : 0;
  info.frequency_mode_hz = static_cast<float>(200'000 + 100'000 * frequency_index(applied.frequency_hz));
  info.lowest_hz = info.highest_hz = static_cast<float>(applied.frequency_hz);
  for (const msg::TransmitSector& sector : sectors_of(applied)) {
    info.lowest_hz = std::min(info.lowest_hz, static_cast<float>(sector.frequency_hz));
    info.highest_hz = std::max(info.highest_hz, static_cast<float>(sector.frequency_hz));
    info.longest_pulse_s = std::max(info.longest_pulse_s, static_cast<float>(sector.pulse_length_s));
    info.longest_effective_pulse_s =
        std::max(info.longest_effective_pulse_s, static_cast<float>(effective_s(applied, sector.pulse_length_s)));
    info.widest_effective_bandwidth_hz =
        std::max(info.widest_effective_bandwidth_hz, static_cast<float>(bandwidth_hz(sector)));
  }
  info.absorption_dbpkm = static_cast<float>(1e3 * applied.gain_absorption_dbpm);
  info.port_edge_deg = edge_deg;
  info.starboard_edge_deg = -edge_deg;
  add_coverage(written, info);
  info.stabilisation = static_cast<std::uint8_t>((applied.pitch_stabilised ? kPitchStabilised : 0) |
                                                 (applied.yaw_stabilised ? kYawStabilised : 0));
  info.filter_2 = kNormalGate | kNormalPhaseRamp;
  info.transmit_array_deg = static_cast<float>(applied.transmit_beamwidth_rad / kDegree);
  info.receive_array_deg = static_cast<float>(applied.receive_beamwidth_rad / kDegree);
  return info;
}

std::vector<formats::kmall::Soundings::Sector> sectors(const msg::AppliedSettings& settings) {
  constexpr std::uint8_t kCentreArray = 1;  // of three; the installation says that all are at the head's origin
  std::vector<formats::kmall::Soundings::Sector> written;
  for (const msg::TransmitSector& sent : sectors_of(settings)) {
    formats::kmall::Soundings::Sector sector;
    sector.number = static_cast<std::uint8_t>(written.size());
    sector.sub_array = kCentreArray;
    sector.delay_s = static_cast<float>(sent.delay_s);
    sector.tilt_deg = static_cast<float>(sent.tilt_rad / kDegree);
    sector.source_level_db = static_cast<float>(sent.source_level_db);
    sector.focus_m = static_cast<float>(sent.focus_range_m);
    sector.centre_hz = static_cast<float>(sent.frequency_hz);
    sector.bandwidth_hz = static_cast<float>(bandwidth_hz(sent));
    sector.pulse_length_s = static_cast<float>(sent.pulse_length_s);
    sector.shading = static_cast<std::uint8_t>(std::round(100.0 * settings.tapered_fraction));
    sector.waveform = waveform_of(sent.pulse);
    sector.effective_length_s = static_cast<float>(effective_s(settings, sent.pulse_length_s));
    written.push_back(sector);
  }
  return written;
}

}  // namespace ensonify::logger::kmall
