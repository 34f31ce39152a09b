#include "scenarios/world/schema.h"

#include <fmt/format.h>

#include "scenarios/scenario_file.h"
#include "scenarios/world/sections.h"

namespace ensonify {

std::string scenario_schema() {
  ParameterList list{other_info("ensonify", "the format", fmt::format(R"({{"const": "{}"}})", kScenarioFormat), true)};
  for (ParameterInfo& info : header_list()) list.push_back(std::move(info));
  list.push_back(section_info("site", "the place of the world", site_list(), true));
  list.push_back(section_info("water", "the water: sound speed, absorption, noise", water_list()));
  list.push_back(section_info("vertical", "water level, chart datum, geoid and ellipsoid", vertical_list()));
  list.push_back(section_info("current", "the current", current_list()));
  list.push_back(section_info("seabed", "the seabed", seabed_list(), true));
  list.push_back(named_info("vehicles", "by names of your own", vehicle_list()));
  list.push_back(section_info("mission", "one of runlines, lawnmower, auto, adaptive, steps, and how they are run",
                              mission_list(), true));
  return parameter_schema("Ensonify scenario", list);
}

}  // namespace ensonify
