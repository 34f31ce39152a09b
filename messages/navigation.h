#pragma once

#include <array>
#include <cstdint>

namespace ensonify::msg {

struct Attitude {
  static constexpr const char* kType = "attitude/1";
  static constexpr const char* kAbout = "What the motion sensor and gyro report.";
  std::int64_t stamp_ns = 0;
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double heading_grid_rad = 0.0;
  double heave_m = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of measurement, sim time", self.stamp_ns);
    visit("roll_rad", "rad", "roll, positive starboard down", self.roll_rad);
    visit("pitch_rad", "rad", "pitch, positive bow up", self.pitch_rad);
    visit("heading_grid_rad", "rad", "heading, clockwise from grid north", self.heading_grid_rad);
    visit("heave_m", "m", "vertical displacement from the mean level, positive up", self.heave_m);
  }
};

struct Position {
  static constexpr const char* kType = "position/1";
  static constexpr const char* kAbout = "What the positioning system reports, referred to the body origin.";
  std::int64_t stamp_ns = 0;
  std::array<double, 3> position_enu_m{};
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double sigma_horizontal_m = 0.0;
  double sigma_vertical_m = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of measurement, sim time", self.stamp_ns);
    visit("position_enu_m", "m", "measured body origin in the world frame: east, north, up", self.position_enu_m);
    visit("latitude_deg", "deg", "geodetic latitude of the same point, WGS 84, positive north", self.latitude_deg);
    visit("longitude_deg", "deg", "longitude of the same point, WGS 84, positive east", self.longitude_deg);
    visit("sigma_horizontal_m", "m", "stated standard deviation, each horizontal axis", self.sigma_horizontal_m);
    visit("sigma_vertical_m", "m", "stated standard deviation, up", self.sigma_vertical_m);
  }
};

struct SoundSpeed {
  static constexpr const char* kType = "sound_speed/1";
  static constexpr const char* kAbout = "What the sound speed probe at the transducers' faces reports.";
  std::int64_t stamp_ns = 0;
  double sound_speed_mps = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of measurement, sim time", self.stamp_ns);
    visit("sound_speed_mps", "m/s", "measured speed of sound in the water at the probe", self.sound_speed_mps);
  }
};

struct Estimate {
  static constexpr const char* kType = "estimate/1";
  static constexpr const char* kAbout =
      "The navigation estimate: what autopilot, agents and records use for where the vehicle is.";
  std::int64_t stamp_ns = 0;
  std::array<double, 3> position_enu_m{};
  std::array<double, 4> enu_from_body{1, 0, 0, 0};
  std::array<double, 3> velocity_enu_mps{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of validity, sim time", self.stamp_ns);
    visit("position_enu_m", "m", "estimated body origin in the world frame: east, north, up", self.position_enu_m);
    visit("enu_from_body", "1", "estimated attitude quaternion w, x, y, z (w >= 0), body FRD to ENU",
          self.enu_from_body);
    visit("velocity_enu_mps", "m/s", "estimated velocity of the body origin", self.velocity_enu_mps);
  }
};

}  // namespace ensonify::msg
