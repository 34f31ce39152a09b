#include "components/coverage/config.h"

#include <fmt/format.h>

#include <cmath>

#include "components/config/config_reader.h"
#include "scenarios/world/own_vehicle.h"

namespace ensonify {
namespace {

constexpr double kMostCells = 32e6;

}  // namespace

CoverageConfig CoverageConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  CoverageConfig config;
  from.optional("rate_hz", config.rate_hz, 1, 10);
  from.optional("head_depth_m", config.head_depth_m, -10, 11000);
  from.optional("cost_per_day", config.cost_per_day, 0, 1e12);
  from.optional("cube_step_m", config.cube_step_m, 0.01, 100);
  const Vehicle vehicle = own_vehicle(from, world, process);
  const Mission& mission = world.mission;
  if (!mission.adaptive) {
    from.problem("", "needs a mission that is adaptive: it says which rectangle is to be covered");
    return config;
  }
  config.plan = *mission.adaptive;
  config.run.speed_mps = config.run.turn_speed_mps = mission.speed_mps;
  config.run.turning_radius_m = vehicle.limits.turning_radius_m;
  config.run.run_in_m = mission.run_in_m;
  config.run.run_out_m = mission.run_out_m;
  config.run.cost_per_day = config.cost_per_day;
  const double finest_m = std::sqrt(config.plan.length_m * config.plan.width_m / kMostCells);
  if (config.cube_step_m < finest_m) {
    from.problem("cube_step_m", fmt::format("makes more than 32 million cells; allowed: {:.3g} m or more", finest_m));
  }
  return config;
}

}  // namespace ensonify
