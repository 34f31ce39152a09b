#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "components/config/parameters.h"
#include "kernels/base/frames/pose.h"
#include "kernels/instruments/navigation_filter/error_state.h"
#include "kernels/instruments/sensors/gnss.h"
#include "kernels/instruments/sensors/instrument_clock.h"
#include "kernels/instruments/sensors/scalar_sensor.h"

/// Keys that all instruments share.
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
    visit("wander_time_s", "s", in(0.1, 1e6), "correlation time of the wandering part", self.wander_s);
    with_unit("white_", 0, "standard deviation of each sample's own error", self.white);
    with_unit("resolution_", 0, "readings are multiples of it", self.resolution);
    visit("lag_s", "s", in(0, 100), "time constant of a first-order response", self.lag_s);
  }
};

template <>
struct ParametersOf<sensors::InstrumentClock> {
  static void parameters(auto& self, auto&& visit) {
    visit("offset_s", "s", in(-86400, 86400), "shown less true at the run's start, when never locked", self.offset_s);
    visit("drift_ppm", "", in(-1000, 1000), "rate error of the free oscillator, parts per million", self.drift_ppm);
    visit("locked", "", any(), "lock of the clock to satellite time: 1PPS and ZDA are wired", self.locked);
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
    visit("height_m", "m", in(0, 1e4), "standard deviation of the height", self.height_m);
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
    visit("rate_hz", "Hz", in(0.01, 1000), "measurements per second", self.rate_hz);
    visit("latency_s", "s", in(0, 10), "time from the measurement to its message", self.latency_s);
    visit("clock", "clock of the instrument, that stamps", self.clock);
    visit("outages_s", "s", in(0, 1e9), "nothing is reported: [from, to, from, to, ...], sim time", self.outages_s);
    visit("position_m", "m", in(-500, 500), "forward, starboard, down from the centre of rotation", self.position_m);
    visit("rotation_deg", "deg", in(-180, 180), "roll, pitch, heading", self.rotation_rad);
    visit("measured_position_m", "m", in(-500, 500), "position as it is assumed to be; left out: the true one",
          self.measured_position_m);
    visit("measured_rotation_deg", "deg", in(-180, 180), "rotation as it is assumed to be; left out: the true one",
          self.measured_rotation_rad);
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

}  // namespace ensonify
