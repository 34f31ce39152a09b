#pragma once

#include <map>
#include <string>
#include <vector>

#include "components/runtime/lockstep/conductor.h"
#include "components/runtime/session.h"
#include "components/runtime/wiring.h"
#include "launch/file/launch_file.h"

namespace ensonify {

/// The launch's options as a later epoch has them. A record by --record keeps its name, in the epoch's folder.
LaunchOptions options_of(const EpochOptions& epoch, LaunchOptions launch);

/// A launch file's `wiring:` as rules with places.
std::vector<WireRule> wire_rules(const Launch& launch);

/// Place of each process's stanza, for messages: "demo.yaml:12:3".
std::map<std::string, std::string> process_places(const Launch& launch);

/// Facts fixed for the run and kept for queries: "launch", "scenario", "version", "seed", "start_utc", "external"
/// (names of the processes that somebody else starts, with spaces between).
std::map<std::string, std::string> facts_of(const Launch& launch);
/// The wiring as the conductor sees it: who waits for whom.
Conductor make_conductor(const Graph& graph, const std::vector<Declaration>& processes, const Launch& launch);

}  // namespace ensonify
