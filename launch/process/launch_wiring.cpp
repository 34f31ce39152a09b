#include "launch/process/launch_wiring.h"

#include <filesystem>

#include "components/runtime/lockstep/local_bus.h"
#include "components/runtime/version.h"

namespace ensonify {

namespace {
namespace fs = std::filesystem;

std::string text_of(const ConfigPlace& place) {
  return place.line == 0 ? place.file
                         : place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}
}  // namespace

LaunchOptions options_of(const EpochOptions& epoch, LaunchOptions launch) {
  launch.sets.insert(launch.sets.end(), epoch.sets.begin(), epoch.sets.end());
  launch.out = epoch.out;
  if (!launch.record.empty()) launch.record = epoch.out + "/" + fs::path(launch.record).filename().string();
  return launch;
}

std::vector<WireRule> wire_rules(const Launch& launch) {
  std::vector<WireRule> rules;
  for (const Connection& c : launch.wiring) {
    rules.push_back({c.process + "." + c.port, c.topic, c.delay.value_or(SimTime{-1}), text_of(c.place)});
  }
  for (const Injection& one : launch.injections) {
    if (one.target.find('/') != std::string::npos) rules.push_back({"", one.target, SimTime{-1}, one.place});
  }
  return rules;
}

std::map<std::string, std::string> process_places(const Launch& launch) {
  std::map<std::string, std::string> places;
  for (const ProcessSpec& process : launch.processes) places[process.name] = text_of(process.place);
  return places;
}

std::map<std::string, std::string> facts_of(const Launch& launch) {
  std::string externals;
  for (const ProcessSpec& process : launch.processes) {
    if (process.external) externals += (externals.empty() ? "" : " ") + process.name;
  }
  std::map<std::string, std::string> facts{{"external", externals},
                                           {"launch", launch.launch_text},
                                           {"scenario", launch.scenario.text},
                                           {"start_utc", launch.scenario.header.start_utc},
                                           {"version", kVersion},
                                           {"isa", name_of(isa_of(launch))},
                                           {"seed", std::to_string(launch.scenario.header.seed)}};
  if (!launch.injections.empty()) facts[kInjectFact] = fact_of(launch.injections);
  return facts;
}

Conductor make_conductor(const Graph& graph, const std::vector<Declaration>& processes, const Launch& launch) {
  Conductor conductor = conductor_of(graph, processes, from_seconds(launch.clock.window_s));
  if (launch.duration) conductor.end_at(*launch.duration);
  return conductor;
}

}  // namespace ensonify
