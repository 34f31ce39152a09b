#pragma once

#include <array>
#include <cstdint>

#include "messages/array.h"

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
  std::int64_t quality = 0;
  double hdop = 0.0;
  double height_above_geoid_m = 0.0;
  double geoid_above_ellipsoid_m = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of measurement, sim time", self.stamp_ns);
    visit("position_enu_m", "m", "measured body origin in the world frame: east, north, up", self.position_enu_m);
    visit("latitude_deg", "deg", "geodetic latitude of the position, WGS 84, positive north", self.latitude_deg);
    visit("longitude_deg", "deg", "longitude of the position, WGS 84, positive east", self.longitude_deg);
    visit("sigma_horizontal_m", "m", "stated standard deviation, each horizontal axis", self.sigma_horizontal_m);
    visit("sigma_vertical_m", "m", "stated standard deviation, up", self.sigma_vertical_m);
    visit("quality", "1", "quality as in NMEA's GGA: 1 single, 2 differential, 4 RTK fixed, 5 RTK float; 0 not given",
          self.quality);
    visit("hdop", "1", "horizontal dilution of precision; 0 not given", self.hdop);
    visit("height_above_geoid_m", "m", "height of the body origin, as in NMEA's GGA", self.height_above_geoid_m);
    visit("geoid_above_ellipsoid_m", "m", "undulation of the geoid at the position, WGS 84, as in NMEA's GGA",
          self.geoid_above_ellipsoid_m);
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
  std::array<double, 9> position_covariance_enu_m2{};
  std::array<double, 9> velocity_covariance_enu_m2ps2{};
  std::array<double, 9> rotation_covariance_enu_rad2{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of validity, sim time", self.stamp_ns);
    visit("position_enu_m", "m", "estimated body origin in the world frame: east, north, up", self.position_enu_m);
    visit("enu_from_body", "1", "estimated attitude quaternion w, x, y, z (w >= 0), body FRD to ENU",
          self.enu_from_body);
    visit("velocity_enu_mps", "m/s", "estimated velocity of the body origin", self.velocity_enu_mps);
    visit("position_covariance_enu_m2", "m2", "covariance of the position's error, row by row; all zero: not given",
          self.position_covariance_enu_m2);
    visit("velocity_covariance_enu_m2ps2", "m2/s2", "covariance of the velocity, row by row: east, north, up",
          self.velocity_covariance_enu_m2ps2);
    visit("rotation_covariance_enu_rad2", "rad2",
          "covariance of the small rotation about east, north, up from estimate to truth, row by row",
          self.rotation_covariance_enu_rad2);
  }
};

struct DelayedHeave {
  static constexpr const char* kType = "delayed_heave/1";
  static constexpr const char* kAbout = "What the motion sensor reports of heave once it knows what came after.";
  std::int64_t stamp_ns = 0;
  double heave_m = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of the heave, long before the message", self.stamp_ns);
    visit("heave_m", "m", "vertical displacement from the mean level, positive up", self.heave_m);
  }
};

struct Heading {
  static constexpr const char* kType = "heading/1";
  static constexpr const char* kAbout = "What a compass reports.";
  std::int64_t stamp_ns = 0;
  double heading_true_rad = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of measurement, by the instrument's clock", self.stamp_ns);
    visit("heading_true_rad", "rad", "heading, clockwise from true north", self.heading_true_rad);
  }
};

struct InertialIncrements {
  static constexpr const char* kType = "inertial_increments/1";
  static constexpr const char* kAbout = "What an inertial measurement unit reports: integrals of what it senses.";
  std::int64_t stamp_ns = 0;
  double interval_s = 0.0;
  std::array<double, 3> angle_rad{};
  std::array<double, 3> velocity_mps{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "end of the interval, sim time", self.stamp_ns);
    visit("interval_s", "s", "interval that is integrated over", self.interval_s);
    visit("angle_rad", "rad", "turn rate against inertial space, integrated, along the unit's axes", self.angle_rad);
    visit("velocity_mps", "m/s", "specific force, integrated, along the unit's axes", self.velocity_mps);
  }
};

struct VelocityLog {
  static constexpr const char* kType = "velocity_log/1";
  static constexpr const char* kAbout = "What a Doppler log reports.";
  std::int64_t stamp_ns = 0;
  bool bottom_lock = false;
  std::array<double, 3> velocity_body_mps{};
  std::array<double, 3> sigma_body_mps{};
  std::array<double, 4> range_m{};
  double altitude_m = 0.0;
  double error_velocity_mps = 0.0;
  bool water_lock = false;
  std::array<double, 3> water_velocity_body_mps{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of measurement, by the instrument's clock", self.stamp_ns);
    visit("bottom_lock", "", "true when velocity is known over ground; else it is zero", self.bottom_lock);
    visit("velocity_body_mps", "m/s",
          "velocity of the transducer over ground, turned to the body's axes as mounting was measured",
          self.velocity_body_mps);
    visit("sigma_body_mps", "m/s", "stated standard deviation of each", self.sigma_body_mps);
    visit("range_m", "m", "along each beam to the bottom; 0: no lock", self.range_m);
    visit("altitude_m", "m", "altitude of the transducer above the bottom; 0: no beam has lock", self.altitude_m);
    visit("error_velocity_mps", "m/s", "difference in which four beams disagree", self.error_velocity_mps);
    visit("water_lock", "", "true when velocity is known through the water; else it is zero", self.water_lock);
    visit(
        "water_velocity_body_mps", "m/s",
        "velocity of the transducer through the water that is tracked, along the body's axes as mounting was measured",
        self.water_velocity_body_mps);
  }
};

struct Depth {
  static constexpr const char* kType = "depth/1";
  static constexpr const char* kAbout = "What a pressure sensor makes of its depth.";
  std::int64_t stamp_ns = 0;
  double depth_m = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of measurement, by the instrument's clock", self.stamp_ns);
    visit("depth_m", "m", "depth of the sensor below the water level", self.depth_m);
  }
};

struct Altitude {
  static constexpr const char* kType = "altitude/1";
  static constexpr const char* kAbout = "What an altimeter measures: distance to the bottom.";
  std::int64_t stamp_ns = 0;
  bool valid = false;
  double range_m = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of measurement, by the instrument's clock", self.stamp_ns);
    visit("valid", "", "true when anything answered", self.valid);
    visit("range_m", "m", "along the beam to the bottom; 0: no answer", self.range_m);
  }
};

struct CurrentProfile {
  static constexpr const char* kType = "current_profile/1";
  static constexpr const char* kAbout = "What a current profiler measures: how water of each bin passes it.";
  std::int64_t stamp_ns = 0;
  Array<double> below_transducer_m;
  Array<double> velocity_body_mps;
  Array<double> sigma_mps;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of measurement, by the instrument's clock", self.stamp_ns);
    visit("below_transducer_m", "m", "bins: distance of each bin's middle along the instrument's axis, rising",
          self.below_transducer_m);
    visit("velocity_body_mps", "m/s",
          "bins x 3: of the water less the transducer's, along the body's axes as mounting was measured",
          self.velocity_body_mps);
    visit("sigma_mps", "m/s", "bins: stated standard deviation of each horizontal component", self.sigma_mps);
  }
};

struct Ctd {
  static constexpr const char* kType = "ctd/1";
  static constexpr const char* kAbout = "What a probe of conductivity, temperature and depth makes of the water.";
  std::int64_t stamp_ns = 0;
  double depth_m = 0.0;
  double temperature_degc = 0.0;
  double salinity_psu = 0.0;
  double sound_speed_mps = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of measurement, by the instrument's clock", self.stamp_ns);
    visit("depth_m", "m", "depth of the probe below the water level", self.depth_m);
    visit("temperature_degc", "degC", "temperature of the water", self.temperature_degc);
    visit("salinity_psu", "psu", "practical salinity of the water", self.salinity_psu);
    visit("sound_speed_mps", "m/s", "computed from the three before", self.sound_speed_mps);
  }
};

struct UsblFix {
  static constexpr const char* kType = "usbl_fix/1";
  static constexpr const char* kAbout = "Where an ultra-short baseline system finds another vehicle's transponder.";
  std::int64_t stamp_ns = 0;
  bool valid = false;
  double range_m = 0.0;
  std::array<double, 3> place_body_m{};
  std::array<double, 3> position_enu_m{};
  std::array<double, 3> sigma_enu_m{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time that the place belongs to, by the instrument's clock", self.stamp_ns);
    visit("valid", "", "true when the transponder replied; else the rest is zero", self.valid);
    visit("range_m", "m", "range from array to transponder, by the sound speed that the system uses", self.range_m);
    visit("place_body_m", "m", "transponder less array, along the carrier's body axes as mounting was measured",
          self.place_body_m);
    visit("position_enu_m", "m", "transponder in the world frame, by the carrier's own estimate", self.position_enu_m);
    visit("sigma_enu_m", "m", "stated standard deviation of each, of the array's measurement alone", self.sigma_enu_m);
  }
};

}  // namespace ensonify::msg
