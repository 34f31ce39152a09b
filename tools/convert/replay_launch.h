#pragma once

#include <string>

#include "tools/convert/recorded_run.h"

namespace ensonify::convert {

struct Wanted {
  std::string logger;    // process of the recorded run whose parameters hold; "": its only one, or none
  std::string head;      // "": as that logger has it, else the only one
  bool sidescan = true;  // or without it, whatever the recorded logger had
};

struct ReplayLaunch {
  std::string text;
  std::string logger;  // its process
  std::string head;    // whose soundings it writes; "": the scenario's only one, or none
};

/// A launch in which the record's processes say again what a logger reads of them, to a logger with these parameters.
/// Its names, times and wiring are those of the recorded run, so that the logger sees what one saw there. `scenario` is
/// the path of a file with the record's scenario, `folder` where files go. Throws UserError: no such logger or head, or
/// several and none named.
ReplayLaunch replay_launch(const RecordedRun& run, const Wanted& wanted, const std::string& scenario,
                           const std::string& folder);

}  // namespace ensonify::convert
