#pragma once

#include <optional>
#include <vector>

#include "kernels/base/frames/pose.h"
#include "kernels/instruments/inertial/imu.h"
#include "kernels/instruments/navigation_filter/error_state.h"
#include "kernels/instruments/sensors/doppler_log.h"
#include "kernels/instruments/sensors/gnss.h"
#include "kernels/instruments/sensors/heading.h"
#include "kernels/instruments/sensors/heave.h"
#include "kernels/instruments/sensors/instrument_clock.h"
#include "kernels/instruments/sensors/level.h"
#include "kernels/instruments/sensors/range_sensor.h"
#include "kernels/instruments/sensors/scalar_sensor.h"
#include "kernels/instruments/sensors/usbl.h"

namespace ensonify {

class ConfigReader;

/// Common parameters of instruments: place, its pace and its clock.
struct Instrument {
  double rate_hz = 1.0;
  double latency_s = 0.0;  // from the measurement to its message
  sensors::Stamping stamping = sensors::Stamping::kMeasurement;
  sensors::InstrumentClock clock;
  std::vector<sensors::Span> outages;  // sim time; nothing is reported
  frames::Mounting actual, measured;   // in the body's frame

  bool out_at(double t_s) const { return sensors::within(outages, t_s); }
};

struct GnssConfig {
  Instrument instrument;
  sensors::GnssErrors errors;
};

struct ImuConfig {
  Instrument instrument;
  inertial::ImuErrors errors;
  navigation_filter::StartErrors alignment;  // how well the system knows itself when the run starts
};

struct MotionSensorConfig {
  Instrument instrument;
  sensors::ScalarErrors angle;        // rad, of roll and pitch each
  sensors::ScalarErrors heave_error;  // m
  sensors::HeaveSettings heave;
  sensors::LevelSettings level;
  double delayed_heave_s = 0.0;  // half width of the window; 0: there is no delayed heave
  frames::Vec3 heave_point_body_m = frames::Vec3::Zero();
};

struct HeadingConfig {
  Instrument instrument;
  sensors::HeadingErrors errors;
};

struct DopplerLogConfig {
  Instrument instrument;
  sensors::JanusGeometry geometry;
  sensors::DopplerErrors errors;
  double water_track_m = 0.0;  // of the water that is tracked below the transducer; 0: water is not tracked
  // What the filter assumes of the current there, north and east each: its standard deviation at the start, and how it
  // changes at random with time and with depth. Assumed: 0.24 m/s in an hour, 0.2 m/s in 50 m.
  double current_prior_mps = 0.3;
  double current_walk_mps_per_sqrt_s = 0.004;
  double current_walk_mps_per_sqrt_m = 0.03;
};

struct DepthConfig {
  Instrument instrument;
  sensors::ScalarErrors errors;  // m
};

struct AltimeterConfig {
  Instrument instrument;
  sensors::RangeErrors errors;
};

struct SoundSpeedConfig {
  Instrument instrument;
  sensors::ScalarErrors errors;  // m/s
};

struct CtdConfig {
  Instrument instrument;
  sensors::ScalarErrors depth;        // m
  sensors::ScalarErrors temperature;  // degC
  sensors::ScalarErrors salinity;     // psu: what the cell's error comes to
};

struct CurrentProfilerConfig {
  Instrument instrument;
  sensors::JanusGeometry geometry;
  sensors::DopplerErrors errors;
  sensors::BinLayout layout;
};

struct UsblConfig {
  Instrument instrument;
  sensors::UsblErrors errors;
  frames::Vec3 transponder_body_m = frames::Vec3::Zero();  // of the target, in its own frame
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
};

/// Instruments of the vehicle; those not given are absent.
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
};

/// Reads the sections gnss, imu, motion_sensor, heading, velocity_log, depth, altimeter, sound_speed, ctd,
/// current_profiler, usbl, usbl_fixes. `grade` in a section names a file of the folder grades, or one of the user's;
/// keys beside it go before those of the file. Positions count from `centre_of_rotation_m` of the body.
Instruments read_instruments(ConfigReader& from);

}  // namespace ensonify
