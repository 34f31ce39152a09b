#include <catch2/catch.hpp>

#include "components/navigation/testing/circle.h"
#include "components/sonar/testing/seabed.h"

using namespace ensonify;
using namespace ensonify::test_run;

// What each instrument errs by when it sits elsewhere, or otherwise turned, than is assumed.

namespace {

using frames::Vec3;

constexpr double kSoundSpeedSlope_ps = 2.0;  // m/s per m of depth
const Vec3 kTransponder_enu_m(60.0, 20.0, -80.0);

/// The circle of `circling` in a seaway: rolls 3 degrees in 8 s, pitches 5 in 6 s.
msg::Pose in_a_seaway(SimTime at) {
  const double t = seconds(at), heading = 0.02 * t;
  const auto swing = [t](double degrees, double period_s) {
    const double w = 2 * kPi / period_s;
    return std::pair{degrees * kDegree * std::sin(w * t), degrees * kDegree * w * std::cos(w * t)};
  };
  const auto [roll, roll_rate] = swing(3, 8);
  const auto [pitch, pitch_rate] = swing(5, 6);
  msg::Pose pose = circling(at, kLevel);
  pose.enu_from_body = frames::wxyz_of(frames::enu_from_body(frames::Attitude{heading, pitch, roll}));
  const Vec3 rates = frames::body_rates_radps({heading, pitch, roll}, {0.02, pitch_rate, roll_rate});
  pose.rate_body_radps = {rates.x(), rates.y(), rates.z()};
  return pose;
}

struct Reading {
  SimTime at;
  Vec3 value;
};

template <class Message, class Value>
std::vector<Reading> reported(const std::string& yaml, const std::string& port, const Value& value) {
  constexpr int kSeconds = 20;
  NavigationConfig config = config_of(yaml);
  config.sigma = {0, 0, 0, 0, 0, 0, 0};
  config.water.sound_speed =
      refraction::SoundSpeedProfile({{0.0, 1450.0}, {100.0, 1450.0 + 100 * kSoundSpeedSlope_ps}});
  NodeUnderTest<NavigationNode> navigation(config);
  if (config.instruments.use_seabed()) {
    navigation.give_at("tile", 0_s, tile_of(512.0, 1.0, [](double, double) { return -20.0; }));
  }
  for (int i = 0; i <= 100 * kSeconds; ++i) {
    if (config.instruments.usbl) {
      msg::Pose target;
      target.stamp_ns = (i * 10_ms).count();
      target.position_enu_m = {kTransponder_enu_m.x(), kTransponder_enu_m.y(), kTransponder_enu_m.z()};
      navigation.give("target", target);
    }
    navigation.give("pose", in_a_seaway(i * 10_ms));
  }
  std::vector<Reading> readings;
  for (const Message& message : navigation.step_until<Message>(port, SimTime{std::chrono::seconds(kSeconds)})) {
    readings.push_back({SimTime{message.stamp_ns}, value(message)});
  }
  return readings;
}

Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

using Readings = std::vector<Reading> (*)(const std::string& yaml);

std::vector<Reading> positions(const std::string& yaml) {
  return reported<msg::Position>(yaml, "position", [](const msg::Position& p) { return vec(p.position_enu_m); });
}
std::vector<Reading> places(const std::string& yaml) {
  return reported<msg::Estimate>(yaml, "estimate", [](const msg::Estimate& e) { return vec(e.position_enu_m); });
}
std::vector<Reading> starboards(const std::string& yaml) {  // where the estimate has the body's second axis
  return reported<msg::Estimate>(yaml, "estimate", [](const msg::Estimate& e) -> Vec3 {
    return frames::quaternion_of(e.enu_from_body) * Vec3::UnitY();
  });
}
std::vector<Reading> velocities(const std::string& yaml) {
  return reported<msg::VelocityLog>(yaml, "velocity_log",
                                    [](const msg::VelocityLog& log) { return vec(log.velocity_body_mps); });
}
std::vector<Reading> currents(const std::string& yaml) {
  return reported<msg::CurrentProfile>(yaml, "current_profile", [](const msg::CurrentProfile& p) {
    return Vec3(p.velocity_body_mps(0, 0), p.velocity_body_mps(0, 1), p.velocity_body_mps(0, 2));
  });
}
std::vector<Reading> headings(const std::string& yaml) {
  return reported<msg::Heading>(yaml, "heading", [](const msg::Heading& h) { return Vec3(h.heading_true_rad, 0, 0); });
}
std::vector<Reading> leanings(const std::string& yaml) {
  return reported<msg::Attitude>(yaml, "attitude",
                                 [](const msg::Attitude& a) { return Vec3(a.roll_rad, a.pitch_rad, 0); });
}
std::vector<Reading> heaves(const std::string& yaml) {
  return reported<msg::Attitude>(yaml, "attitude", [](const msg::Attitude& a) { return Vec3(0, 0, a.heave_m); });
}
std::vector<Reading> depths(const std::string& yaml) {
  return reported<msg::Depth>(yaml, "depth", [](const msg::Depth& d) { return Vec3(0, 0, d.depth_m); });
}
std::vector<Reading> ctd_depths(const std::string& yaml) {
  return reported<msg::Ctd>(yaml, "ctd", [](const msg::Ctd& ctd) { return Vec3(0, 0, ctd.depth_m); });
}
std::vector<Reading> sound_speeds(const std::string& yaml) {
  return reported<msg::SoundSpeed>(yaml, "sound_speed",
                                   [](const msg::SoundSpeed& s) { return Vec3(s.sound_speed_mps, 0, 0); });
}
std::vector<Reading> ranges(const std::string& yaml) {
  return reported<msg::Altitude>(yaml, "altitude", [](const msg::Altitude& a) { return Vec3(0, 0, a.range_m); });
}
std::vector<Reading> transponders(const std::string& yaml) {
  return reported<msg::UsblFix>(yaml, "usbl", [](const msg::UsblFix& fix) { return vec(fix.place_body_m); });
}

Eigen::AngleAxisd degree_about(const Vec3& axis) { return Eigen::AngleAxisd(kDegree, axis); }
/// What turns to v in an instrument that is turned by a degree.
Vec3 seen_turned(const Vec3& v, const Vec3& axis) { return degree_about(axis).inverse() * v - v; }
Vec3 velocity_body(const frames::MovingPose& truth) {
  return truth.pose.enu_from_body.conjugate() * truth.velocity_enu_mps;
}
/// Height of a point of the body over its origin.
double height_m(const frames::MovingPose& truth, const Vec3& point_body_m) {
  return (truth.pose.enu_from_body * point_body_m).z();
}

struct Misfit {
  std::string what, right, wrong;
  Readings readings;
  Vec3 (*error)(const frames::MovingPose& truth);
  double margin;
  SimTime from{0};
};

// An ideal inertial unit that knows where it starts.
const std::string kAligned = "alignment: { position_m: 0, height_m: 0, velocity_mps: 0, tilt_deg: 0, heading_deg: 0 }";
const std::string kHeightUnknown =
    "imu: { alignment: { position_m: 0, height_m: 5, velocity_mps: 0, tilt_deg: 0, heading_deg: 0 } }\n";
// A filter so slow that of swings of 6 s all but 2 z w0 / w = 0.8 % is heave, and as much again dies away with it.
const std::string kSlow = "heave_cutoff_s: 1000, heave_damping: 0.7";

const std::vector<Misfit> kMisfits{
    {"an antenna 0.1 m ahead of where it is believed", "gnss: { position_m: [-1, 0, -3] }",
     "gnss: { position_m: [-1, 0, -3], measured_position_m: [-1.1, 0, -3] }", positions,
     [](const frames::MovingPose& truth) -> Vec3 { return truth.pose.enu_from_body * Vec3(0.1, 0, 0); },
     1.5e-4},  // by the attitude of 10 ms before: 0.1 m x 0.1 rad/s x 0.01 s
    {"an inertial unit 0.1 m ahead of where it is believed", "imu: { position_m: [2, 0, 0.3], " + kAligned + " }",
     "imu: { position_m: [2, 0, 0.3], measured_position_m: [1.9, 0, 0.3], " + kAligned + " }", places,
     [](const frames::MovingPose& truth) -> Vec3 { return truth.pose.enu_from_body * Vec3(0.1, 0, 0); }, 1e-6},
    {"an inertial unit heeled by a degree", "imu: { " + kAligned + " }",
     "imu: { rotation_deg: [1, 0, 0], measured_rotation_deg: [0, 0, 0], " + kAligned + " }", starboards,
     [](const frames::MovingPose& truth) -> Vec3 {
       const Vec3 starboard = Vec3::UnitY();
       return truth.pose.enu_from_body * (degree_about(Vec3::UnitX()) * starboard - starboard);
     },
     1e-6},
    {"a velocity log turned to starboard by a degree", "velocity_log: {}",
     "velocity_log: { rotation_deg: [0, 0, 1], measured_rotation_deg: [0, 0, 0] }", velocities,
     [](const frames::MovingPose& truth) { return seen_turned(velocity_body(truth), Vec3::UnitZ()); }, 1e-9},
    {"a current profiler turned to starboard by a degree, in still water", "current_profiler: {}",
     "current_profiler: { rotation_deg: [0, 0, 1], measured_rotation_deg: [0, 0, 0] }", currents,
     [](const frames::MovingPose& truth) { return seen_turned(-velocity_body(truth), Vec3::UnitZ()); }, 1e-9},
    {"a compass turned to starboard by a degree", "heading: {}",
     "heading: { rotation_deg: [0, 0, 1], measured_rotation_deg: [0, 0, 0] }", headings,
     [](const frames::MovingPose& truth) {
       const auto heading = [&](const Vec3& axis) {
         const Vec3 forward = truth.pose.enu_from_body * axis;
         return std::atan2(forward.x(), forward.y());
       };
       return Vec3(heading(degree_about(Vec3::UnitZ()) * Vec3::UnitX()) - heading(Vec3::UnitX()), 0, 0);
     },
     1e-9},
    {"a motion sensor heeled by a degree", "motion_sensor: {}",
     "motion_sensor: { rotation_deg: [1, 0, 0], measured_rotation_deg: [0, 0, 0] }", leanings,
     [](const frames::MovingPose&) { return Vec3(kDegree, 0, 0); }, 1e-9},
    {"heave 10 m ahead of the sensor", "motion_sensor: { " + kSlow + " }",
     "motion_sensor: { heave_point_m: [10, 0, 0], " + kSlow + " }", heaves,
     [](const frames::MovingPose& truth) {
       return Vec3(0, 0, 10 * std::sin(frames::attitude_of(truth.pose.enu_from_body).pitch_rad));
     },
     0.017 * 10 * std::sin(5 * kDegree)},
    {"a motion sensor 1 m ahead of where it is believed", "motion_sensor: { " + kSlow + " }",
     "motion_sensor: { position_m: [1, 0, 0], measured_position_m: [0, 0, 0], " + kSlow + " }", heaves,
     [](const frames::MovingPose& truth) {
       return Vec3(0, 0, std::sin(frames::attitude_of(truth.pose.enu_from_body).pitch_rad));
     },
     0.017 * std::sin(5 * kDegree)},
    {"a pressure sensor 0.5 m lower", "depth: {}", "depth: { position_m: [0, 0, 0.5] }", depths,
     [](const frames::MovingPose& truth) {
       return Vec3(0, 0, -height_m(truth, {0, 0, 0.5}));
     },
     1e-9},
    {"a pressure sensor 0.5 m lower than the filter believes", kHeightUnknown + "depth: { position_m: [0, 0, 0.5] }",
     kHeightUnknown + "depth: { position_m: [0, 0, 0.5], measured_position_m: [0, 0, 0] }", places,
     [](const frames::MovingPose&) { return Vec3(0, 0, -0.5); }, 0.005, 10_s},  // less 1 - cos of the swings, 0.5 %
    {"a CTD 0.5 m lower", "ctd: {}", "ctd: { position_m: [0, 0, 0.5] }", ctd_depths,
     [](const frames::MovingPose& truth) {
       return Vec3(0, 0, -height_m(truth, {0, 0, 0.5}));
     },
     1e-9},
    {"a sound speed probe 0.5 m lower", "sound_speed: {}", "sound_speed: { position_m: [0, 0, 0.5] }", sound_speeds,
     [](const frames::MovingPose& truth) {
       return Vec3(-kSoundSpeedSlope_ps * height_m(truth, {0, 0, 0.5}), 0, 0);
     },
     1e-9},
    {"an altimeter heeled by a degree", "altimeter: {}", "altimeter: { rotation_deg: [1, 0, 0] }", ranges,
     [](const frames::MovingPose& truth) {
       const auto range_m = [&](const Vec3& axis) { return 19.0 / -height_m(truth, axis); };
       return Vec3(0, 0, range_m(degree_about(Vec3::UnitX()) * Vec3::UnitZ()) - range_m(Vec3::UnitZ()));
     },
     1e-3},  // the tile's heights are floats
    {"a USBL array turned to starboard by a degree", "usbl: {}",
     "usbl: { rotation_deg: [0, 0, 1], measured_rotation_deg: [0, 0, 0] }", transponders,
     [](const frames::MovingPose& truth) {
       const Vec3 place_body_m =
           truth.pose.enu_from_body.conjugate() * (kTransponder_enu_m - truth.pose.position_enu_m);
       return seen_turned(place_body_m, Vec3::UnitZ());
     },
     0.012},  // stamped when the transponder answered, 67 ms before: 0.1 rad/s x 100 m x 0.067 s, by a degree
    {"a centre of rotation ahead of the body's origin and below it: depth", "depth: {}",
     "centre_of_rotation_m: [3, 0, 1]\ndepth: {}", depths,
     [](const frames::MovingPose& truth) {
       return Vec3(0, 0, -height_m(truth, {3, 0, 1}));
     },
     1e-9},
    {"a centre of rotation ahead of the body's origin: heave", "motion_sensor: { " + kSlow + " }",
     "centre_of_rotation_m: [10, 0, 0]\nmotion_sensor: { " + kSlow + " }", heaves,
     [](const frames::MovingPose& truth) {
       return Vec3(0, 0, 10 * std::sin(frames::attitude_of(truth.pose.enu_from_body).pitch_rad));
     },
     0.017 * 10 * std::sin(5 * kDegree)},
    {"a centre of rotation that is known: positions", "gnss: { position_m: [-1, 0, -3] }",
     "centre_of_rotation_m: [3, 0, 1]\ngnss: { position_m: [-4, 0, -4] }", positions,
     [](const frames::MovingPose&) { return Vec3(0, 0, 0); }, 1e-9},
};

}  // namespace

TEST_CASE("an instrument mounted otherwise than measured errs by its closed form", "[long]") {
  for (const Misfit& misfit : kMisfits) {
    INFO(misfit.what);
    const std::vector<Reading> right = misfit.readings(misfit.right), wrong = misfit.readings(misfit.wrong);
    REQUIRE(right.size() > 5);
    REQUIRE(right.size() == wrong.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < right.size(); ++i) {
      if (right[i].at < misfit.from) continue;
      const frames::MovingPose truth = moving_pose(in_a_seaway(right[i].at));
      worst = std::max(worst, (wrong[i].value - right[i].value - misfit.error(truth)).norm());
    }
    CHECK(worst < misfit.margin);
  }
}
