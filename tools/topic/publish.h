#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/runtime/run_finder.h"
#include "messages/codec.h"
#include "messages/schema.h"

namespace ensonify::topic_tool {

/// What `ensonify topic pub` publishes, and as whom.
struct Publication {
  std::string run;                  // as --run takes it
  std::string topic;                // PROCESS/PORT
  std::string type;                 // "guidance/1"
  std::vector<std::string> fields;  // FIELD=VALUE
  double rate_hz = 10.0;            // sim time
  std::uint64_t count = 0;          // messages to publish; 0: until the run ends
};

/// A message from assignments such as "speed_mps=1.5" and "position_enu_m=[1, 2, 3]", values as YAML. What is not named
/// keeps the type's default where it is received. Throws UserError, naming field, value and what is allowed.
msg::Value message_of(const msg::TypeInfo& type, const std::vector<std::string>& assignments);

/// The absolute directory of a run's sockets, however the run was found; "" for one over tcp that is known by its
/// endpoint only.
std::string socket_folder(const LiveRun& run);

/// Joins a run that still awaits this participant, which its launch file must declare `external`, publishes, and stays
/// to the end of the run. `stamp_ns`, where the type has one and none is given, is the sim time of publishing. Returns
/// the exit code; throws UserError for a participant, topic, type or field that cannot be.
int publish(const Publication& wanted);

}  // namespace ensonify::topic_tool
