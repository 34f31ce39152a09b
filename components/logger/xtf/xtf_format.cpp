#include "components/logger/xtf/xtf_format.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "components/formats/xtf/writer.h"
#include "components/logger/head_track.h"
#include "components/logger/xtf/file_header.h"

namespace ensonify::logger {

using namespace formats::xtf;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

XtfMoment xtf_moment(const Moment& moment) {
  XtfMoment at;
  at.unix_ns = moment.unix_ns;
  at.ship_latitude_deg = at.sensor_latitude_deg = moment.reference.latitude_deg;
  at.ship_longitude_deg = at.sensor_longitude_deg = moment.reference.longitude_deg;
  at.roll_deg = moment.roll_deg;
  at.pitch_deg = moment.pitch_deg;
  at.heading_deg = moment.heading_deg;
  at.heave_up_m = -moment.heave_down_m;
  at.speed_mps = moment.speed_mps;
  return at;
}

}  // namespace

XtfFormat::XtfFormat(const LoggerConfig& config, std::string mark, std::optional<msg::HeadDeclaration> sidescan,
                     std::optional<msg::HeadDeclaration> multibeam)
    : config_(config),
      mark_(std::move(mark)),
      sidescan_(std::move(sidescan)),
      multibeam_(std::move(multibeam)),
      clock_{config.start_unix_ns} {}

void XtfFormat::begin(const FileStart& start, formats::Bytes& out) {
  append(out, xtf_file_header(start.name, sidescan_, multibeam_, config_.xtf_samples));
  append(out, packet_of(xtf_notes(start.unix_ns, mark_)));
}

void XtfFormat::moment(const Moment& moment, formats::Bytes& out) {
  speed_mps_ = moment.speed_mps;
  append(out, packet_of(xtf_attitude(xtf_moment(moment), clock_)));
  if (moment.position_due) append(out, packet_of(xtf_navigation(xtf_moment(moment))));
}

XtfMoment XtfFormat::moment_at(const msg::HeadTrack& track, const Vessel& vessel, std::int64_t unix_ns,
                               double heave_down_m, const frames::LocalProjection& world) const {
  const frames::Pose body = body_pose_of(track, vessel);
  const frames::Vec3 head_enu_m = frames::enu_from_body(body, vessel.head.position_body_m);
  const frames::Attitude attitude = frames::attitude_of(body.enu_from_body);
  const frames::Geodetic ship = world.geodetic_of(body.position_enu_m.head<2>());
  const frames::Geodetic sensor = world.geodetic_of(head_enu_m.head<2>());
  const double heading_rad = attitude.heading_rad + world.convergence_rad(body.position_enu_m.head<2>());
  XtfMoment at;
  at.unix_ns = unix_ns;
  at.ship_latitude_deg = ship.latitude_deg;
  at.ship_longitude_deg = ship.longitude_deg;
  at.sensor_latitude_deg = sensor.latitude_deg;
  at.sensor_longitude_deg = sensor.longitude_deg;
  at.sensor_depth_m = vessel.dives ? std::max(0.0, -head_enu_m.z()) : vessel.transducer_depth_m(body, heave_down_m);
  at.roll_deg = attitude.roll_rad / kDegree;
  at.pitch_deg = attitude.pitch_rad / kDegree;
  at.heading_deg = frames::wrap_two_pi(heading_rad) / kDegree;
  at.heave_up_m = -heave_down_m;
  at.speed_mps = speed_mps_;
  return at;
}

void XtfFormat::ping(const LoggedSoundings& ping, formats::Bytes& out) {
  const msg::Soundings& soundings = ping.soundings;
  const XtfMoment at = moment_at(soundings.track, config_.vessel, ping.unix_ns, ping.heave_down_m, ping.world);
  append(out, packet_of(xtf_multibeam(
                  xtf_ping_header(at, clock_, soundings.ping, soundings.applied.sound_speed_mps, 0.0), soundings)));
}

void XtfFormat::ping(const LoggedSidescan& ping, formats::Bytes& out) {
  const msg::Ping& first = ping.ping.transmissions.front();
  const XtfMoment at = moment_at(first.track, config_.sidescan_vessel, ping.unix_ns, ping.heave_down_m, ping.world);
  SonarPing written{.header = xtf_ping_header(at, clock_, first.ping, first.applied.sound_speed_mps,
                                              ping.ping.altitude_m.value_or(0.0))};
  for (const msg::Ping& transmission : ping.ping.transmissions) {
    auto channels =
        xtf_channels(transmission, static_cast<std::uint16_t>(written.channels.size()), config_.xtf_samples);
    std::move(channels.begin(), channels.end(), std::back_inserter(written.channels));
  }
  if (!written.channels.empty()) append(out, packet_of(std::move(written)));
}

}  // namespace ensonify::logger
