#pragma once

#include <optional>
#include <string>
#include <vector>

#include "messages/console.h"
#include "messages/mission.h"
#include "messages/terrain.h"

namespace ensonify::console {

/// What is planned, for the chart: the runlines of the scenario, those that an adaptive survey adds, and marks.
class Plan {
 public:
  /// The scenario's runlines, of its text as a run's facts and a record have it. None of one that cannot be read here.
  void read(const std::string& scenario);
  /// The run's chart, over which `mission.auto` lays its lines. Of several vehicles it is not known whose they are:
  /// none.
  void take(const msg::Chart& chart);
  void take(const msg::NextLine& next);
  void take(const msg::Mark& mark);
  void clear() { *this = {}; }

  msg::ConsolePlan message() const;

 private:
  void lay();

  std::string to_lay_;               // scenario that waits for a chart
  std::optional<msg::Chart> chart_;  // that waits for a scenario
  std::vector<double> lines_enu_m_;  // start east, north, end east, north of each
  std::size_t planned_ = 0;          // of these: from the scenario
  std::vector<msg::ConsoleMark> marks_;
};

}  // namespace ensonify::console
