#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/navigation/instrument_keys.h"
#include "kernels/instruments/inertial/imu.h"
#include "kernels/instruments/sensors/gnss.h"
#include "kernels/instruments/sensors/heave.h"

/// Instruments of where the vehicle is and how it is turned.
namespace ensonify {

struct GnssConfig : InstrumentConfig<GnssConfig> {
  static constexpr const char* kSection = "gnss";
  sensors::GnssErrors errors;

  GnssConfig() { instrument.rate_hz = 5.0; }
  static void errors_list(auto& self, auto&& visit) {
    using Fix = sensors::FixQuality;
    const Allowed qualities = one_of({{"single", Fix::kSingle},
                                      {"differential", Fix::kDifferential},
                                      {"rtk_float", Fix::kRtkFloat},
                                      {"rtk_fixed", Fix::kRtkFixed}});
    auto& errors = self.errors;
    visit("quality", "", qualities, "best quality of fixes", errors.best);
    visit("degraded_quality", "", qualities, "quality from the first fix on, until fixes are at their best",
          errors.while_degraded);
    visit("fix", "standard deviations at their best, at a dilution of 1", errors.fix);
    visit("degraded_fix", "standard deviations from the first fix on, until fixes are at their best", errors.degraded);
    visit("wander_time_s", "s", in(1, 1e6), "correlation time of the slow errors", errors.wander_s);
    visit("first_fix_s", "s", in(0, 3600), "time from the antenna's coming up to a fix", errors.first_fix_s);
    visit("converge_s", "s", in(0, 36000), "time from a fix to fixes at their best", errors.converge_s);
    visit("hdop", "", in(0.5, 50), "mean dilution; errors are multiplied by it", errors.hdop);
    visit("hdop_wander", "", in(0, 1), "change of the dilution at random, relative", errors.hdop_wander);
    visit("washed_depth_m", "m", in(-10, 10), "an antenna lower than this above the water is under it",
          errors.washed_depth_m);
  }
};

/// Errors of three gyros or accelerometers, of which keys and units differ.
struct GyroErrors : inertial::TriadErrors {
  static void parameters(auto& self, auto&& visit) {
    visit("bias_degph", "deg/h", in(0, 1e5), "standard deviation of a bias that is drawn once", self.turn_on_bias);
    visit("stability_degph", "deg/h", in(0, 1e5), "standard deviation of a Gauss-Markov bias", self.bias_sigma);
    visit("stability_time_s", "s", in(1, 1e6), "correlation time of the bias's wander", self.bias_time_s);
    visit("random_walk_deg_per_sqrt_h", "deg/sqrt(h)", in(0, 100), "random walk of the angle: white noise of the rate",
          self.random_walk);
    visit("rate_random_walk_radps_per_sqrt_s", "rad/s/sqrt(s)", in(0, 1), "random walk of the bias",
          self.rate_random_walk);
    visit("scale_ppm", "ppm", in(0, 1e5), "standard deviation", self.scale_factor);
    visit("misalignment_deg", "deg", in(0, 5), "standard deviation of each small angle", self.misalignment_rad);
    visit("quantum_deg", "deg", in(0, 1), "smallest step of the integrated reading", self.quantum);
  }
};
struct AccelerometerErrors : inertial::TriadErrors {
  static void parameters(auto& self, auto&& visit) {
    visit("bias_ug", "ug", in(0, 1e6), "standard deviation of a bias that is drawn once", self.turn_on_bias);
    visit("stability_ug", "ug", in(0, 1e6), "standard deviation of a Gauss-Markov bias", self.bias_sigma);
    visit("stability_time_s", "s", in(1, 1e6), "correlation time of the bias's wander", self.bias_time_s);
    visit("random_walk_ug_per_sqrt_hz", "ug/sqrt(Hz)", in(0, 1e5),
          "random walk of the velocity: white noise of the force", self.random_walk);
    visit("rate_random_walk_mps2_per_sqrt_s", "m/s^2/sqrt(s)", in(0, 1), "random walk of the bias",
          self.rate_random_walk);
    visit("scale_ppm", "ppm", in(0, 1e5), "standard deviation", self.scale_factor);
    visit("misalignment_deg", "deg", in(0, 5), "standard deviation of each small angle", self.misalignment_rad);
    visit("quantum_mps", "m/s", in(0, 1), "smallest step of the integrated reading", self.quantum);
  }
};

struct ImuConfig : InstrumentConfig<ImuConfig> {
  static constexpr const char* kSection = "imu";
  GyroErrors gyro;
  AccelerometerErrors accelerometer;
  navigation_filter::StartErrors alignment;  // how well the system knows itself when the run starts

  ImuConfig() { instrument.rate_hz = 100.0; }
  inertial::ImuErrors errors() const { return {gyro, accelerometer}; }

  static void errors_list(auto& self, auto&& visit) {
    visit("gyro", "errors of each axis", self.gyro);
    visit("accelerometer", "errors of each axis", self.accelerometer);
    visit("alignment", "standard deviations of what the system starts with", self.alignment);
  }
  void check(const ConfigReader& from) const;
};

struct MotionSensorConfig : InstrumentConfig<MotionSensorConfig> {
  static constexpr const char* kSection = "motion_sensor";
  QuantityErrors<InDegrees, 30> angle;  // of roll and pitch each
  QuantityErrors<InMetres, 5> heave_error;
  sensors::HeaveSettings heave{.cutoff_s = 100.0};
  sensors::LevelSettings level;
  double delayed_heave_s = 0.0;  // half width of the window; 0: there is no delayed heave
  frames::Vec3 heave_point_body_m = frames::Vec3::Zero();

  MotionSensorConfig() { instrument.rate_hz = 100.0; }
  static void parameters(auto& self, auto&& visit) {
    InstrumentConfig::parameters(self, visit);
    visit("heave_point_m", "m", in(-500, 500), "whose heave is reported, from the centre of rotation",
          self.heave_point_body_m);
  }
  static void errors_list(auto& self, auto&& visit) {
    visit("angle", "errors of roll and pitch each", self.angle);
    visit("heave", "errors of heave", self.heave_error);
    visit("heave_cutoff_s", "s", in(1, 1000), "period of the filter's corner", self.heave.cutoff_s);
    visit("heave_damping", "", in(0.1, 10), "damping ratio of the heave filter", self.heave.damping);
    visit("level_time_s", "s", in(0.1, 1e4), "time constant with which level follows mean force", self.level.time_s);
    visit("level_aided", "", in(0, 1), "share of a turn's acceleration that is known and taken off",
          self.level.aided_share);
    visit("delayed_heave_s", "s", in(0, 600), "half width of its window; 0: there is no delayed heave",
          self.delayed_heave_s);
  }
};

struct HeadingConfig : InstrumentConfig<HeadingConfig> {
  static constexpr const char* kSection = "heading";
  QuantityErrors<InDegrees, 30> angle;
  sensors::HeadingErrors errors;

  HeadingConfig() { instrument.rate_hz = 10.0; }
  static void errors_list(auto& self, auto&& visit) {
    auto& errors = self.errors;
    visit("kind", "", one_of({{"gyro", sensors::HeadingKind::kGyro}, {"magnetic", sensors::HeadingKind::kMagnetic}}),
          "a gyro or satellite compass, or a magnetic one", errors.kind);
    visit("errors", "errors of the angle", self.angle);
    visit("speed_corrected", "", any(), "gyro: the steaming error is taken off", errors.speed_corrected);
    visit("variation_error_deg", "deg", in(-180, 180), "magnetic: declination entered less true",
          errors.variation_error_rad);
    visit("deviation_deg", "deg", in(-90, 90), "magnetic: coefficients A to E of what swinging leaves, as they are",
          errors.deviation.abcde_rad);
    visit("deviation_sigma_deg", "deg", in(0, 90),
          "magnetic: standard deviations of further coefficients A to E that are drawn once",
          errors.deviation_sigma.abcde_rad);
  }
};

struct UsblConfig : InstrumentConfig<UsblConfig> {
  static constexpr const char* kSection = "usbl";
  sensors::UsblErrors errors;
  frames::Vec3 transponder_body_m = frames::Vec3::Zero();  // of the target, in its own frame

  UsblConfig() { instrument.rate_hz = 0.5; }
  static void parameters(auto& self, auto&& visit) {
    InstrumentConfig::parameters(self, visit);
    visit("transponder_m", "m", in(-500, 500),
          "transponder on the target: forward, starboard, down from its body's origin", self.transponder_body_m);
  }
  static void errors_list(auto& self, auto&& visit) {
    auto& errors = self.errors;
    visit("range_white_m", "m", in(0, 100), "white noise", errors.range_white_m);
    visit("sound_speed_percent", "%", in(-10, 10), "error of the speed that makes range of time, as it is",
          errors.sound_speed_scale);
    visit("bearing_white_deg", "deg", in(0, 10), "white noise of each of two angles, on the array's axis",
          errors.bearing_white_rad);
    visit("longest_m", "m", in(1, 10000), "range beyond which there is no answer", errors.longest_m);
    visit("widest_deg", "deg", in(1, 90), "angle from the array's axis beyond which there is no answer",
          errors.widest_rad);
    visit("outlier", "", in(0, 1), "probability that a reflection is taken for the answer", errors.outlier);
    visit("sound_speed_mps", "m/s", in(1300, 1700), "mean over the path, for the age of the fix",
          errors.speed_of_sound_mps);
  }
};

/// Filter's model of fixes by another vehicle, besides the noise of its array: standard
/// deviations of what changes slowly, but for the white one.
struct UsblFixesConfig {
  frames::Vec3 transponder_body_m = frames::Vec3::Zero();  // of this vehicle, as measured
  double place_m = 0.1;                                    // of the other vehicle, each axis
  double attitude_rad = 0.0017;                            // of it with its array, each axis
  double attitude_white_rad = 0.0009;
  double sound_speed_share = 0.001;  // of the range
  double wander_s = 300.0;           // correlation time of the slow ones

  static void parameters(auto& self, auto&& visit) {
    visit("position_m", "m", in(-500, 500), "position of the transponder, from the centre of rotation",
          self.transponder_body_m);
    visit("place_m", "m", in(0, 100), "slow error of the other vehicle's place, each axis", self.place_m);
    visit("attitude_deg", "deg", in(0, 10), "slow error of the other vehicle's attitude with its array, each axis",
          self.attitude_rad);
    visit("attitude_white_deg", "deg", in(0, 10),
          "white error of the other vehicle's attitude with its array, each axis", self.attitude_white_rad);
    visit("sound_speed_percent", "%", in(0, 10), "slow error of the sound speed, of the range", self.sound_speed_share);
    visit("wander_time_s", "s", in(1, 1e6), "correlation time of the slow errors", self.wander_s);
  }
};

}  // namespace ensonify
