#pragma once

#include <string>
#include <vector>

#include "components/runtime/wiring.h"
#include "launch/commands.h"
#include "launch/file/launch_file.h"
#include "scenarios/world/mission.h"

namespace ensonify::launcher {

/// Answers of a launch's programs to --check.
struct CheckedPorts {
  std::vector<Declaration> declarations;  // of those that could be asked, in the order of ranks
  std::vector<std::string> problems;      // what is wrong with files and arguments
  std::vector<std::string> unknown;       // external processes and programs that do not know --check
};

/// Starts every program of the launch with --check, one after another. A program that says nothing within ten seconds
/// is ended and counted as unknown.
CheckedPorts check_ports(const Launch& launch, const RunPlaces& places);

/// Objections of the seabed to the mission of a launch without a pager, which checks it itself before time
/// starts.
std::vector<std::string> unpaged_mission_problems(const Launch& launch, const RunPlaces& places);

/// Wiring mistakes, each with its place. Nothing is said when some processes are unknown or could not report their
/// ports, since those may be the publishers that seem to be missing.
std::vector<std::string> wiring_problems(const Launch& launch, const CheckedPorts& checked);

/// Settings of the mission that a head of the launch does not take, where an autopilot runs the mission.
std::vector<std::string> setting_problems(const Mission& mission, const CheckedPorts& checked);

/// Warning of terrain too coarse for a head: its posts are farther apart than its finest footprint, the narrowest
/// beam at the least depth. Names both.
std::vector<std::string> resolution_warnings(const CheckedPorts& checked);

}  // namespace ensonify::launcher
