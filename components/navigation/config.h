#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "components/navigation/instrument_config.h"
#include "components/navigation/world_frame.h"
#include "kernels/water/column.h"
#include "kernels/water/refraction/profile.h"
#include "kernels/water/sound_speed.h"
#include "scenarios/world/world.h"

namespace ensonify {

/// The water as it is, by depth below chart datum.
struct TrueWater {
  refraction::SoundSpeedProfile sound_speed = refraction::SoundSpeedProfile::uniform(1500.0);
  water::Column column{{water::SeaWater{}}};  // temperature and salinity
  water::SoundSpeedLaw law = water::SoundSpeedLaw::kMackenzie;
};

/// The simplest instruments, in place of those that are not listed: truth and white noise. Standard deviations, each
/// sample and axis on its own.
struct NavigationErrors {
  static constexpr double kDegree_rad = 3.14159265358979323846 / 180.0;

  double roll_rad = 0.02 * kDegree_rad;
  double pitch_rad = 0.02 * kDegree_rad;
  double heading_rad = 0.05 * kDegree_rad;
  double heave_m = 0.02;
  double horizontal_m = 0.05;
  double vertical_m = 0.05;
  double velocity_mps = 0.02;
};

/// The sound speed probe, meant to sit beside the transducers' faces.
struct SoundSpeedProbe {
  std::array<double, 3> position_body_m{};  // forward, starboard, down from the body's origin
  int rate_hz = 1;
  double bias_mps = 0.0;    // measured minus true, the same all through a run
  double sigma_mps = 0.02;  // white noise
  double latency_s = 0.0;   // from the measurement to its report
};

/// Parameters of default.yaml.
struct NavigationParameters {
  std::string vehicle;
  int attitude_rate_hz = 100;  // attitude and estimate
  int position_rate_hz = 5;
  double position_gain = 0.2;       // how much of a fix's difference from the estimate is taken over, 0..1
  double motion_latency_s = 0.0;    // age of attitude and velocity at their stamp: a sensor that does not state its own
  double position_latency_s = 0.0;  // the same of the estimate's east and north
  NavigationErrors sigma;
  SoundSpeedProbe probe;
  std::array<double, 3> centre_body_m{};
  Instruments instruments;

  static void parameters(auto& self, auto&& visit) {
    visit("vehicle", "", any(), "vehicle of the scenario; \"\": the one with the process's name, or the only one",
          self.vehicle);
    visit("attitude_rate_hz", "Hz", in(1, 1000), "attitude and estimate", self.attitude_rate_hz);
    visit("position_rate_hz", "Hz", in(1, 100), "fixes", self.position_rate_hz);
    visit("position_gain", "", in(0.001, 1), "part of a fix's difference from the estimate that is taken over",
          self.position_gain);
    visit("motion_latency_s", "s", in(0, 10), "age of attitude, heave and velocity at their stamp",
          self.motion_latency_s);
    visit("position_latency_s", "s", in(0, 10), "age of the estimate's east and north at its stamp",
          self.position_latency_s);
    visit("sigma_roll_deg", "deg", in(0, 10), "white noise where no instrument is listed, each sample on its own",
          self.sigma.roll_rad);
    visit("sigma_pitch_deg", "deg", in(0, 10), "standard deviation of the pitch's white noise", self.sigma.pitch_rad);
    visit("sigma_heading_deg", "deg", in(0, 10), "standard deviation of the heading's white noise",
          self.sigma.heading_rad);
    visit("sigma_heave_m", "m", in(0, 5), "standard deviation of the heave's white noise", self.sigma.heave_m);
    visit("sigma_horizontal_m", "m", in(0, 100),
          "standard deviation of the position's white noise, each of east and north", self.sigma.horizontal_m);
    visit("sigma_vertical_m", "m", in(0, 100), "standard deviation of the height's white noise", self.sigma.vertical_m);
    visit("sigma_velocity_mps", "m/s", in(0, 5), "standard deviation of the velocity's white noise, each axis",
          self.sigma.velocity_mps);
    visit("sound_speed_position_m", "m", in(-500, 500),
          "position of the probe, meant to sit beside the transducers' faces: forward, starboard, down from the body's "
          "origin",
          self.probe.position_body_m);
    visit("sound_speed_rate_hz", "Hz", in(1, 100), "measurements of the probe per second", self.probe.rate_hz);
    visit("sound_speed_bias_mps", "m/s", in(-50, 50), "measured minus true sound speed, constant through a run",
          self.probe.bias_mps);
    visit("sigma_sound_speed_mps", "m/s", in(0, 10), "white noise of the probe", self.probe.sigma_mps);
    visit("sound_speed_latency_s", "s", in(0, 10), "time from the probe's measurement to its report",
          self.probe.latency_s);
    visit("centre_of_rotation_m", "m", in(-500, 500),
          "centre of rotation of the body; positions of the instruments count from it", self.centre_body_m);
    Instruments::parameters(self.instruments, visit);
  }
  static NavigationParameters read(ConfigReader& from);
};

struct NavigationConfig : NavigationParameters {
  std::uint64_t seed = 1;
  std::string process;
  Heights heights;
  std::optional<frames::Geodetic> origin;  // not given: the chart gives it
  TrueWater water;

  static NavigationConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
