#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "components/config/parameters.h"
#include "kernels/base/frames/pose.h"
#include "kernels/instruments/inertial/imu.h"
#include "kernels/instruments/navigation_filter/error_state.h"
#include "kernels/instruments/sensors/doppler_log.h"
#include "kernels/instruments/sensors/gnss.h"
#include "kernels/instruments/sensors/heave.h"
#include "kernels/instruments/sensors/instrument_clock.h"
#include "kernels/instruments/sensors/scalar_sensor.h"

namespace ensonify {

class ConfigReader;

// Units that end keys: white_m, white_deg.
// clang-format off
struct InMetres { static constexpr const char *kKey = "m", *kUnit = "m"; };
struct InDegrees { static constexpr const char *kKey = "deg", *kUnit = "deg"; };
struct InMetresPerSecond { static constexpr const char *kKey = "mps", *kUnit = "m/s"; };
struct InCelsius { static constexpr const char *kKey = "degc", *kUnit = "degC"; };
struct InPracticalSalinity { static constexpr const char *kKey = "psu", *kUnit = "psu"; };
// clang-format on

/// Errors of a sensor of one quantity, each at most kMost of its unit.
template <class Unit, int kMost>
struct QuantityErrors : sensors::ScalarErrors {
  static void parameters(auto& self, auto&& visit) {
    const auto with_unit = [&](std::string key, int least, const char* about, auto& member) {
      visit((key + Unit::kKey).c_str(), Unit::kUnit, in(least, kMost), about, member);
    };
    with_unit("bias_", -kMost, "measured less true, as it is", self.bias);
    with_unit("bias_sigma_", 0, "standard deviation of a further bias that is drawn once", self.bias_sigma);
    visit("scale_percent", "%", in(0, 100), "standard deviation of a factor that is drawn once", self.scale);
    with_unit("wander_", 0, "standard deviation of a Gauss-Markov error", self.wander);
    visit("wander_time_s", "s", in(0.1, 1e6), "its correlation time", self.wander_s);
    with_unit("white_", 0, "standard deviation of each sample's own error", self.white);
    with_unit("resolution_", 0, "readings are multiples of it", self.resolution);
    visit("lag_s", "s", in(0, 100), "time constant of a first-order response", self.lag_s);
  }
};

template <>
struct ParametersOf<sensors::InstrumentClock> {
  static void parameters(auto& self, auto&& visit) {
    visit("offset_s", "s", in(-86400, 86400), "shown less true at the run's start, when never locked", self.offset_s);
    visit("drift_ppm", "", in(-1000, 1000), "of the free oscillator, parts per million", self.drift_ppm);
    visit("locked", "", any(), "1PPS and ZDA are wired", self.locked);
    visit("residual_s", "s", in(-1, 1), "shown less true while locked", self.residual_s);
    visit("unlocked_s", "s", in(0, 1e9), "the pulse is lost: [from, to, from, to, ...], sim time", self.unlocked_s);
  }
  static void check(const ConfigReader& from, const sensors::InstrumentClock& clock);
};

template <>
struct ParametersOf<sensors::FixErrors> {
  static void parameters(auto& self, auto&& visit) {
    visit("horizontal_m", "m", in(0, 100), "white noise, each of east and north", self.horizontal_m);
    visit("vertical_m", "m", in(0, 100), "white noise", self.vertical_m);
    visit("wander_horizontal_m", "m", in(0, 100), "slow error, each of east and north", self.wander_horizontal_m);
    visit("wander_vertical_m", "m", in(0, 100), "slow error", self.wander_vertical_m);
  }
};

template <>
struct ParametersOf<navigation_filter::StartErrors> {
  static void parameters(auto& self, auto&& visit) {
    visit("position_m", "m", in(0, 1e5), "each of north and east", self.position_m);
    visit("height_m", "m", in(0, 1e4), "of the height", self.height_m);
    visit("velocity_mps", "m/s", in(0, 10), "each axis", self.velocity_mps);
    visit("tilt_deg", "deg", in(0, 10), "about each horizontal axis", self.tilt_rad);
    visit("heading_deg", "deg", in(0, 30), "about the vertical", self.heading_rad);
  }
};

/// Common parameters of instruments: place, pace and clock.
struct Instrument {
  std::string grade;
  double rate_hz = 1.0;
  double latency_s = 0.0;  // from the measurement to its message
  sensors::Stamping stamping = sensors::Stamping::kMeasurement;
  sensors::InstrumentClock clock;
  std::vector<double> outages_s;  // sim time: from, to, from, to; nothing is reported
  std::array<double, 3> position_m{}, rotation_rad{};
  std::optional<std::array<double, 3>> measured_position_m, measured_rotation_rad;
  frames::Mounting actual, measured;  // in the body's frame: what the four above come to

  bool out_at(double t_s) const { return sensors::within(outages_s, t_s); }
  /// Sets the mountings. Places count from the body's centre of rotation.
  void mount(const frames::Vec3& centre_body_m);

  static void parameters(auto& self, auto&& visit) {
    visit("grade", "", any(), "name of its errors, or a file *.yaml of them; keys beside it go before the file's",
          self.grade);
    visit("rate_hz", "Hz", in(0.01, 1000), "how often it measures", self.rate_hz);
    visit("latency_s", "s", in(0, 10), "from the measurement to its message", self.latency_s);
    visit("clock", "its own clock, that stamps", self.clock);
    visit("outages_s", "s", in(0, 1e9), "nothing is reported: [from, to, from, to, ...], sim time", self.outages_s);
    visit("position_m", "m", in(-500, 500), "forward, starboard, down from the centre of rotation", self.position_m);
    visit("rotation_deg", "deg", in(-180, 180), "roll, pitch, heading", self.rotation_rad);
    visit("measured_position_m", "m", in(-500, 500), "as it is assumed to be; left out: as it is",
          self.measured_position_m);
    visit("measured_rotation_deg", "deg", in(-180, 180), "the same", self.measured_rotation_rad);
    stamped_at(self, visit);
  }
  /// Of the parameters, the one that a grade's file may have.
  static void stamped_at(auto& self, auto&& visit) {
    visit("stamped_at", "",
          one_of({{"measurement", sensors::Stamping::kMeasurement}, {"output", sensors::Stamping::kOutput}}),
          "the moment that the stamp is of", self.stamping);
  }
};

/// What configurations of instruments share. Their `errors_list` names what a grade's file may have.
template <class Config>
struct InstrumentConfig {
  Instrument instrument;

  static void parameters(auto& self, auto&& visit) {
    Instrument::parameters(self.instrument, visit);
    Config::errors_list(self, visit);
  }
  /// Reads the file of the grade.
  void read_base(ConfigReader& from);
  void check(const ConfigReader& from) const;
};

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
    visit("quality", "", qualities, "of fixes at their best", errors.best);
    visit("degraded_quality", "", qualities, "from the first fix on, until they are at their best",
          errors.while_degraded);
    visit("fix", "standard deviations at their best, at a dilution of 1", errors.fix);
    visit("degraded_fix", "the same until then", errors.degraded);
    visit("wander_time_s", "s", in(1, 1e6), "correlation time of the slow errors", errors.wander_s);
    visit("first_fix_s", "s", in(0, 3600), "from the antenna's coming up to a fix", errors.first_fix_s);
    visit("converge_s", "s", in(0, 36000), "from a fix to the best", errors.converge_s);
    visit("hdop", "", in(0.5, 50), "mean dilution; errors are multiplied by it", errors.hdop);
    visit("hdop_wander", "", in(0, 1), "how much it changes, relative", errors.hdop_wander);
    visit("washed_depth_m", "m", in(-10, 10), "an antenna lower than this above the water is under it",
          errors.washed_depth_m);
  }
};

/// Errors of three gyros or accelerometers, of which keys and units differ.
struct GyroErrors : inertial::TriadErrors {
  static void parameters(auto& self, auto&& visit) {
    visit("bias_degph", "deg/h", in(0, 1e5), "standard deviation of a bias that is drawn once", self.turn_on_bias);
    visit("stability_degph", "deg/h", in(0, 1e5), "standard deviation of a Gauss-Markov bias", self.bias_sigma);
    visit("stability_time_s", "s", in(1, 1e6), "its correlation time", self.bias_time_s);
    visit("random_walk_deg_per_sqrt_h", "deg/sqrt(h)", in(0, 100), "of the angle: white noise of the rate",
          self.random_walk);
    visit("rate_random_walk_radps_per_sqrt_s", "rad/s/sqrt(s)", in(0, 1), "of the bias", self.rate_random_walk);
    visit("scale_ppm", "ppm", in(0, 1e5), "standard deviation", self.scale_factor);
    visit("misalignment_deg", "deg", in(0, 5), "standard deviation of each small angle", self.misalignment_rad);
    visit("quantum_deg", "deg", in(0, 1), "smallest step of the integrated reading", self.quantum);
  }
};
struct AccelerometerErrors : inertial::TriadErrors {
  static void parameters(auto& self, auto&& visit) {
    visit("bias_ug", "ug", in(0, 1e6), "standard deviation of a bias that is drawn once", self.turn_on_bias);
    visit("stability_ug", "ug", in(0, 1e6), "standard deviation of a Gauss-Markov bias", self.bias_sigma);
    visit("stability_time_s", "s", in(1, 1e6), "its correlation time", self.bias_time_s);
    visit("random_walk_ug_per_sqrt_hz", "ug/sqrt(Hz)", in(0, 1e5), "of the velocity: white noise of the force",
          self.random_walk);
    visit("rate_random_walk_mps2_per_sqrt_s", "m/s^2/sqrt(s)", in(0, 1), "of the bias", self.rate_random_walk);
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
    visit("heave_damping", "", in(0.1, 10), "of the filter", self.heave.damping);
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

/// Of Doppler logs and current profilers.
void doppler_list(auto& geometry, auto& errors, auto&& visit) {
  visit("slant_deg", "deg", in(5, 60), "of each beam from down", geometry.slant_rad);
  visit("first_azimuth_deg", "deg", in(-180, 180), "of the first beam, from forward to starboard",
        geometry.first_azimuth_rad);
  visit("beam_white_mps", "m/s", in(0, 5), "white noise of one beam's single ping", errors.beam_white_mps);
  visit("scale_percent", "%", in(0, 20), "standard deviation of a factor that is drawn once", errors.scale);
  visit("longest_m", "m", in(0.1, 2000), "range along a beam", errors.longest_m);
}

struct DopplerLogConfig : InstrumentConfig<DopplerLogConfig> {
  static constexpr const char* kSection = "velocity_log";
  sensors::JanusGeometry geometry;
  sensors::DopplerErrors errors;
  double water_track_m = 0.0;  // of the water that is tracked below the transducer; 0: water is not tracked
  // What the filter assumes of the current there, north and east each: its standard deviation at the start, and how it
  // changes at random with time and with depth. Assumed: 0.24 m/s in an hour, 0.2 m/s in 50 m.
  double current_prior_mps = 0.3;
  double current_walk_mps_per_sqrt_s = 0.004;
  double current_walk_mps_per_sqrt_m = 0.03;

  DopplerLogConfig() { instrument.rate_hz = 5.0; }
  static void parameters(auto& self, auto&& visit) {
    InstrumentConfig::parameters(self, visit);
    visit("water_track_m", "m", in(0, 500), "of the water that is tracked below the transducer; 0: it is not",
          self.water_track_m);
    visit("current_prior_mps", "m/s", in(0, 10), "the filter's current at the start, each of north and east",
          self.current_prior_mps);
    visit("current_walk_mps_per_sqrt_s", "m/s/sqrt(s)", in(0, 1), "how it changes with time",
          self.current_walk_mps_per_sqrt_s);
    visit("current_walk_mps_per_sqrt_m", "m/s/sqrt(m)", in(0, 10), "how it changes with depth",
          self.current_walk_mps_per_sqrt_m);
  }
  static void errors_list(auto& self, auto&& visit) {
    doppler_list(self.geometry, self.errors, visit);
    visit("beam_white_percent", "%", in(0, 100), "white noise: this share of a beam's radial speed besides",
          self.errors.beam_white_share);
    visit("dropout", "", in(0, 1), "probability that a beam's ping fails in range", self.errors.dropout);
    visit("shortest_m", "m", in(0, 100), "range along a beam", self.errors.shortest_m);
  }
  void check(const ConfigReader& from) const;
};

struct DepthConfig : InstrumentConfig<DepthConfig> {
  static constexpr const char* kSection = "depth";
  QuantityErrors<InMetres, 100> errors;

  DepthConfig() { instrument.rate_hz = 10.0; }
  static void errors_list(auto& self, auto&& visit) { visit("errors", "errors of depth", self.errors); }
};

struct AltimeterConfig : InstrumentConfig<AltimeterConfig> {
  static constexpr const char* kSection = "altimeter";
  QuantityErrors<InMetres, 10> distance;
  sensors::RangeErrors errors;

  AltimeterConfig() { instrument.rate_hz = 5.0; }
  static void errors_list(auto& self, auto&& visit) {
    visit("errors", "errors of the distance", self.distance);
    visit("shortest_m", "m", in(0, 100), "nearer it does not answer", self.errors.shortest_m);
    visit("longest_m", "m", in(0.1, 2000), "farther it does not answer", self.errors.longest_m);
    visit("dropout", "", in(0, 1), "probability of no answer in range", self.errors.dropout);
  }
  void check(const ConfigReader& from) const;
};

struct SoundSpeedConfig : InstrumentConfig<SoundSpeedConfig> {
  static constexpr const char* kSection = "sound_speed";
  QuantityErrors<InMetresPerSecond, 50> errors;

  static void errors_list(auto& self, auto&& visit) { visit("errors", "errors of sound speed", self.errors); }
};

struct CtdConfig : InstrumentConfig<CtdConfig> {
  static constexpr const char* kSection = "ctd";
  QuantityErrors<InMetres, 100> depth;
  QuantityErrors<InCelsius, 10> temperature;
  QuantityErrors<InPracticalSalinity, 10> salinity;  // what the cell's error comes to

  CtdConfig() { instrument.rate_hz = 4.0; }
  static void errors_list(auto& self, auto&& visit) {
    visit("depth", "errors of depth", self.depth);
    visit("temperature", "errors of temperature", self.temperature);
    visit("salinity", "errors of salinity: what the cell's come to", self.salinity);
  }
};

struct CurrentProfilerConfig : InstrumentConfig<CurrentProfilerConfig> {
  static constexpr const char* kSection = "current_profiler";
  sensors::JanusGeometry geometry;
  sensors::DopplerErrors errors;
  sensors::BinLayout layout;

  static void errors_list(auto& self, auto&& visit) {
    doppler_list(self.geometry, self.errors, visit);
    visit("blanking_m", "m", in(0, 100), "depth below the transducer at which the first bin begins",
          self.layout.blanking_m);
    visit("bin_m", "m", in(0.05, 100), "thickness of a bin", self.layout.thickness_m);
    visit("bins", "", in(1, 200), "how many", self.layout.count);
  }
};

struct UsblConfig : InstrumentConfig<UsblConfig> {
  static constexpr const char* kSection = "usbl";
  sensors::UsblErrors errors;
  frames::Vec3 transponder_body_m = frames::Vec3::Zero();  // of the target, in its own frame

  UsblConfig() { instrument.rate_hz = 0.5; }
  static void parameters(auto& self, auto&& visit) {
    InstrumentConfig::parameters(self, visit);
    visit("transponder_m", "m", in(-500, 500), "on the target: forward, starboard, down from its body's origin",
          self.transponder_body_m);
  }
  static void errors_list(auto& self, auto&& visit) {
    auto& errors = self.errors;
    visit("range_white_m", "m", in(0, 100), "white noise", errors.range_white_m);
    visit("sound_speed_percent", "%", in(-10, 10), "error of the speed that makes range of time, as it is",
          errors.sound_speed_scale);
    visit("bearing_white_deg", "deg", in(0, 10), "white noise of each of two angles, on the array's axis",
          errors.bearing_white_rad);
    visit("longest_m", "m", in(1, 10000), "farther there is no answer", errors.longest_m);
    visit("widest_deg", "deg", in(1, 90), "from the array's axis: beyond, there is no answer", errors.widest_rad);
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
    visit("position_m", "m", in(-500, 500), "of the transponder, from the centre of rotation", self.transponder_body_m);
    visit("place_m", "m", in(0, 100), "slow error of the other vehicle's place, each axis", self.place_m);
    visit("attitude_deg", "deg", in(0, 10), "slow error of its attitude with its array, each axis", self.attitude_rad);
    visit("attitude_white_deg", "deg", in(0, 10), "white error of the same", self.attitude_white_rad);
    visit("sound_speed_percent", "%", in(0, 10), "slow error, of the range", self.sound_speed_share);
    visit("wander_time_s", "s", in(1, 1e6), "correlation time of the slow ones", self.wander_s);
  }
};

/// Instruments of the vehicle; those not given are absent. `grade` in a section names a file of the folder grades, or
/// one of the user's.
struct Instruments {
  std::optional<GnssConfig> gnss;
  std::optional<ImuConfig> imu;
  std::optional<MotionSensorConfig> motion_sensor;
  std::optional<HeadingConfig> heading;
  std::optional<DopplerLogConfig> velocity_log;
  std::optional<DepthConfig> depth;
  std::optional<AltimeterConfig> altimeter;
  std::optional<SoundSpeedConfig> sound_speed;
  std::optional<CtdConfig> ctd;
  std::optional<CurrentProfilerConfig> current_profiler;
  std::optional<UsblConfig> usbl;
  std::optional<UsblFixesConfig> usbl_fixes;

  bool need_seabed() const { return velocity_log || altimeter; }
  bool use_seabed() const { return need_seabed() || current_profiler; }
  void mount(const frames::Vec3& centre_body_m);

  static void parameters(auto& self, auto&& visit) {
    visit("gnss", "satellite receiver, if carried", self.gnss);
    visit("imu", "inertial unit, if carried: with it the estimate is a Kalman filter's", self.imu);
    visit("motion_sensor", "roll, pitch and heave, if carried", self.motion_sensor);
    visit("heading", "compass, if carried", self.heading);
    visit("velocity_log", "Doppler log, if carried", self.velocity_log);
    visit("depth", "pressure sensor, if carried", self.depth);
    visit("altimeter", "distance to the seabed, if carried", self.altimeter);
    visit("sound_speed", "probe, if carried: in place of sound_speed_*", self.sound_speed);
    visit("ctd", "conductivity, temperature, depth, if carried", self.ctd);
    visit("current_profiler", "water speed over depth, if carried", self.current_profiler);
    visit("usbl", "array, if carried, that finds the transponder of the vehicle at port target", self.usbl);
    visit("usbl_fixes", "fixes of this vehicle by another's array, if the filter takes them", self.usbl_fixes);
  }
};

}  // namespace ensonify
