#include "components/logger/testing/survey.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace ensonify::logger::testing {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

World bay() {
  World world;
  world.site.origin = {54.0, 8.0};
  world.start_unix_ns = 1'748'779'200'000'000'000;  // 2025-06-01 12:00:00
  world.mission.depth_m = kReferenceDepth_m;
  world.water.profile.sound_speed_mps = kSoundSpeed_mps;
  Vehicle boat;
  boat.name = "boat";
  HeadMounting bow;
  bow.measured.position_body_m = {1.5, 0.2, 0.8};
  bow.measured.body_from_head = frames::enu_from_ned().conjugate() *
                                frames::enu_from_body({.heading_rad = 0.01, .pitch_rad = 0.02, .roll_rad = -0.03});
  boat.mountings["bow"] = bow;
  world.vehicles = {boat};
  return world;
}

LoggerConfig config_of(const World& world, const char* text) {
  ConfigReader from = ConfigReader::from_text(text, "logger.yaml");
  LoggerConfig config = LoggerConfig::read(from, world, "logger");
  from.finish();
  return config;
}

double heave_up_m(SimTime t) { return 0.3 * std::sin(1.1 * seconds(t)); }
frames::Pose pose_at(SimTime t) {
  const double t_s = seconds(t);
  frames::Pose pose;
  pose.position_enu_m = {20'000.0 + 2.0 * t_s, 1'000.0 + 2.0 * t_s, heave_up_m(t) - kReferenceDepth_m};
  pose.enu_from_body = frames::enu_from_body({.heading_rad = 45 * kDegree,
                                              .pitch_rad = 3 * kDegree * std::sin(t_s),
                                              .roll_rad = 8 * kDegree * std::cos(0.9 * t_s)});
  return pose;
}

void give_navigation(NodeUnderTest<LoggerNode>& logger, SimTime until) {
  for (SimTime t{0}; t <= until; t += 10_ms) {
    const frames::Pose pose = pose_at(t);
    msg::Estimate estimate;
    estimate.stamp_ns = t.count();
    estimate.position_enu_m = {pose.position_enu_m.x(), pose.position_enu_m.y(), pose.position_enu_m.z()};
    estimate.enu_from_body = frames::wxyz_of(pose.enu_from_body);
    estimate.velocity_enu_mps = {2.0, 2.0, 0.0};
    logger.give("estimate", estimate);
    msg::Attitude attitude;
    attitude.stamp_ns = t.count();
    attitude.heave_m = heave_up_m(t);
    logger.give("attitude", attitude);
  }
  msg::Position position;
  position.quality = 4;
  position.hdop = 0.8;
  position.height_above_geoid_m = 3.0;
  logger.give("position", position);
}

msg::Soundings ping_at(SimTime t, std::int64_t number, const frames::Mounting& mounting) {
  const frames::HeadPose head = frames::head_pose(pose_at(t), mounting);
  msg::Soundings soundings;
  soundings.stamp_ns = t.count();
  soundings.ping = number;
  soundings.sample_period_s = 5e-5;
  soundings.applied.sound_speed_mps = kSoundSpeed_mps;
  soundings.applied.frequency_hz = 300e3;
  soundings.applied.pulse_length_s = 1e-4;
  soundings.beam_angle_rad = msg::Array<float>({kBeams});
  soundings.travel_time_s = msg::Array<float>({kBeams});
  soundings.backscatter_strength_db = msg::Array<float>({kBeams});
  soundings.range_sd_m = msg::Array<float>({kBeams});
  soundings.window_s = msg::Array<float>({kBeams});
  soundings.kind = msg::Array<std::uint8_t>({kBeams});
  soundings.valid = msg::Array<std::uint8_t>({kBeams});
  soundings.position_enu_m = msg::Array<double>({kBeams, 3});
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double angle_rad = (static_cast<double>(i) - 50.0) * kDegree;
    const frames::Vec3 direction = head.enu_from_head * frames::Vec3(0.0, std::sin(angle_rad), std::cos(angle_rad));
    const double range_m = (kSeabedDepth_m + head.position_enu_m.z()) / -direction.z();
    const frames::Vec3 where = head.position_enu_m + range_m * direction;
    const bool valid = i % 10 != 0;
    const auto no = std::numeric_limits<double>::quiet_NaN();
    soundings.beam_angle_rad[i] = static_cast<float>(angle_rad);
    soundings.travel_time_s[i] = static_cast<float>(valid ? 2.0 * range_m / kSoundSpeed_mps : no);
    soundings.backscatter_strength_db[i] = static_cast<float>(valid ? -25.0 - 0.1 * static_cast<double>(i) : no);
    soundings.range_sd_m[i] = 0.02F;
    soundings.window_s[i] = 1e-3F;
    soundings.kind[i] = i < 40 || i > 60 ? 2 : 1;
    soundings.valid[i] = valid ? 1 : 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      soundings.position_enu_m(i, axis) = valid ? where[static_cast<Eigen::Index>(axis)] : no;
    }
  }
  soundings.track.pose_position_enu_m = msg::Array<double>({1, 3});
  soundings.track.pose_enu_from_head = msg::Array<double>({1, 4});
  const auto wxyz = frames::wxyz_of(head.enu_from_head);
  for (std::size_t k = 0; k < 3; ++k)
    soundings.track.pose_position_enu_m[k] = head.position_enu_m[static_cast<Eigen::Index>(k)];
  for (std::size_t k = 0; k < 4; ++k) soundings.track.pose_enu_from_head[k] = wxyz[k];
  return soundings;
}

msg::Ping column_of(const msg::Soundings& soundings) {
  msg::Ping column;
  column.stamp_ns = soundings.stamp_ns;
  column.ping = soundings.ping;
  column.sample_period_s = kColumnPeriod_s;
  column.applied = soundings.applied;
  column.applied.source_level_db = kSourceLevel_db;
  column.applied.gain_spreading_db = 30.0;
  column.applied.gain_absorption_dbpm = 0.06;
  column.beam_angle_rad = soundings.beam_angle_rad;
  column.amplitude_upa = msg::Array<float>({kBeams, kColumnSamples});
  for (std::size_t beam = 0; beam < kBeams; ++beam) {
    const double bottom = static_cast<double>(soundings.travel_time_s[beam]) / kColumnPeriod_s;
    for (std::size_t k = 0; k < kColumnSamples; ++k) {
      const double level_db =
          100.0 + 0.1 * static_cast<double>(beam) + (std::abs(static_cast<double>(k) - bottom) < 0.5 ? 60.0 : 0.0);
      column.amplitude_upa(beam, k) = static_cast<float>(std::pow(10.0, level_db / 20.0));
    }
  }
  return column;
}

void survey(const World& world, const char* text, const std::filesystem::path& folder) {
  const LoggerConfig config = config_of(world, text);
  NodeUnderTest<LoggerNode> logger(config, "logger", folder);
  give_navigation(logger, 10_s);
  std::int64_t number = 65'500;
  for (SimTime t{0}; t <= 9_s; t += kPingPeriod) {
    const msg::Soundings soundings = ping_at(t, number++, config.vessel.head);
    logger.give("soundings", soundings);
    if (config.water_column() && soundings.ping % 3 == 0) logger.give("bow/ping", column_of(soundings));
  }
  logger.run_until(10_s);
  logger.node().finish_run();
}

}  // namespace ensonify::logger::testing
