#pragma once

#include <string>

#include "messages/console.h"
#include "messages/mission.h"

namespace ensonify::console {

/// What is planned, for the chart: the runlines of the scenario, those that an adaptive survey adds, and marks.
class Plan {
 public:
  /// The scenario's runlines, of its text as a run's facts and a record have it. None of one that cannot be read here,
  /// or whose lines are laid over a raster.
  void read(const std::string& scenario);
  void take(const msg::NextLine& next);
  void take(const msg::Mark& mark);
  void clear() { *this = {}; }

  msg::ConsolePlan message() const;

 private:
  std::vector<double> lines_enu_m_;  // start east, north, end east, north of each
  std::size_t planned_ = 0;          // of these: from the scenario
  std::vector<msg::ConsoleMark> marks_;
};

}  // namespace ensonify::console
