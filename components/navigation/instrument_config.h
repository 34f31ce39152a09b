#pragma once

#include <optional>

#include "components/navigation/motion_config.h"
#include "components/navigation/water_config.h"

namespace ensonify {

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
