#include "components/coverage/config.h"

#include <fmt/format.h>

#include <cmath>

#include "components/config/read_parameters.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

constexpr double kMostCells = 32e6;

}  // namespace

CoverageConfig CoverageConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  CoverageConfig config;
  read_parameters<CoverageParameters>(from, config);
  const Vehicle vehicle = own_vehicle(from, world, process, config.vehicle);
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
