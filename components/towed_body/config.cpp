#include "components/towed_body/config.h"

#include "components/config/config_reader.h"
#include "scenarios/world/own_vehicle.h"

namespace ensonify {
namespace {

void read_cable(ConfigReader from, motion::TowCable& cable) {
  from.optional("out_m", cable.out_m, 1, 10000);
  from.optional("diameter_m", cable.diameter_m, 1e-4, 1);
  from.optional("weight_npm", cable.weight_npm, 0, 1000);
  from.optional("normal_drag", cable.normal_drag, 0, 10);
  from.optional("tangential_drag", cable.tangential_drag, 0, 10);
}

void read_body(ConfigReader from, motion::TowedBody& body) {
  from.optional("weight_n", body.weight_n, 1, 1e6);
  from.optional("drag_area_m2", body.drag_area_m2, 0, 100);
}

void read_positioning(ConfigReader from, TowPositioning& positioning) {
  from.optional_choice("by", positioning.by,
                       {{"layback", TowPositioning::By::kLayback}, {"usbl", TowPositioning::By::kUsbl}});
  from.optional("cable_scale", positioning.cable_scale, -0.5, 0.5);
  from.optional("layback_factor", positioning.layback_factor, 0.1, 1.5);
  from.optional("usbl_gain", positioning.usbl_gain, 0.001, 1);
  from.optional("depth_white_m", positioning.depth_white_m, 0, 100);
  from.optional("heading_white_deg", positioning.heading_white_rad, 0, 90, kDegrees);
  from.optional("level_white_deg", positioning.level_white_rad, 0, 90, kDegrees);
}

auto tied(const motion::TowCable& c) {
  return std::tie(c.out_m, c.diameter_m, c.weight_npm, c.normal_drag, c.tangential_drag);
}
auto tied(const motion::TowedBody& b) { return std::tie(b.weight_n, b.drag_area_m2); }

}  // namespace

bool TowedBodyConfig::operator==(const TowedBodyConfig& other) const {
  return pose_rate_hz == other.pose_rate_hz && tied(cable) == tied(other.cable) && tied(body) == tied(other.body) &&
         sheave_m == other.sheave_m && depth_lag_s == other.depth_lag_s && positioning == other.positioning;
}

TowedBodyConfig TowedBodyConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  TowedBodyConfig config;
  from.optional("pose_rate_hz", config.pose_rate_hz, 10, 200);
  if (const auto cable = from.optional_section("cable")) read_cable(*cable, config.cable);
  if (const auto body = from.optional_section("body")) read_body(*body, config.body);
  from.optional("sheave_m", config.sheave_m, -500, 500);
  from.optional("depth_lag_s", config.depth_lag_s, 0.1, 10000);
  if (const auto section = from.optional_section("positioning")) read_positioning(*section, config.positioning);
  const Vehicle vehicle = own_vehicle(from, world, process);
  config.process = process;
  config.name = vehicle.name;
  config.seed = world.seed;
  config.disturbance = vehicle.disturbance;
  config.current = world.current;
  return config;
}

}  // namespace ensonify
