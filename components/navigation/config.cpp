#include "components/navigation/config.h"

#include "components/config/config_reader.h"
#include "components/sonar/environment.h"
#include "scenarios/world/own_vehicle.h"

namespace ensonify {

NavigationConfig NavigationConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  NavigationConfig config;
  from.optional("attitude_rate_hz", config.attitude_rate_hz, 1, 1000);
  from.optional("position_rate_hz", config.position_rate_hz, 1, 100);
  from.optional("position_gain", config.position_gain, 0.001, 1);
  from.optional("motion_latency_s", config.motion_latency_s, 0, 10);
  from.optional("position_latency_s", config.position_latency_s, 0, 10);
  NavigationErrors& sigma = config.sigma;
  from.optional("sigma_roll_deg", sigma.roll_rad, 0, 10, kDegrees);
  from.optional("sigma_pitch_deg", sigma.pitch_rad, 0, 10, kDegrees);
  from.optional("sigma_heading_deg", sigma.heading_rad, 0, 10, kDegrees);
  from.optional("sigma_heave_m", sigma.heave_m, 0, 5);
  from.optional("sigma_horizontal_m", sigma.horizontal_m, 0, 100);
  from.optional("sigma_vertical_m", sigma.vertical_m, 0, 100);
  from.optional("sigma_velocity_mps", sigma.velocity_mps, 0, 5);
  SoundSpeedProbe& probe = config.probe;
  from.optional("sound_speed_position_m", probe.position_body_m, -500, 500);
  from.optional("sound_speed_rate_hz", probe.rate_hz, 1, 100);
  from.optional("sound_speed_bias_mps", probe.bias_mps, -50, 50);
  from.optional("sigma_sound_speed_mps", probe.sigma_mps, 0, 10);
  from.optional("sound_speed_latency_s", probe.latency_s, 0, 10);

  config.instruments = read_instruments(from);
  const Vehicle vehicle = own_vehicle(from, world, process);  // the pose itself is wired
  config.seed = world.seed;
  config.process = process;
  config.heights = {world.vertical.tide, world.vertical.datums, world.current, vehicle.floats,
                    vehicle.start ? vehicle.start->position_enu_m.z() : -world.mission.depth_m};
  if (!world.site.origin_from_raster) config.origin = world.site.origin;
  config.water = {true_profile(world), true_column(world.water), world.water.sound_speed_law};
  return config;
}

}  // namespace ensonify
