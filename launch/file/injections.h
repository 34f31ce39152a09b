#pragma once

#include <vector>

#include "launch/file/launch_keys.h"

namespace ensonify {

/// What a launch file injects. Problems of `from`: a process that is not there, one that somebody else starts and that
/// is to be killed or paused, an end before the start. Whether an output exists is known only once the wiring is.
std::vector<Injection> read_injections(const ConfigReader& from, const std::vector<InjectKeys>& keys,
                                       const std::vector<ProcessSpec>& processes);

/// The reverse, as a file has them.
std::vector<InjectKeys> keys_of(const std::vector<Injection>& injections);

/// As they stand in the resolved launch; a null without any.
ConfigNode node_of(const std::vector<Injection>& injections);

}  // namespace ensonify
