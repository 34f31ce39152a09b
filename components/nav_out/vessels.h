#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "components/nav_out/instruments.h"
#include "components/nav_out/pace.h"

namespace ensonify::nav_out {

/// The other vessels of a launch, as their transponders report of them: what each last knew of itself. A radio under
/// water reaches nobody.
class Vessels {
 public:
  /// Deeper than this below chart datum no report leaves.
  static constexpr double kSilentBelow_m = 5.0;

  /// `names` in the order in which identities count on from `first_mmsi`.
  Vessels(const std::vector<std::string>& names, std::uint32_t first_mmsi);

  void take(const std::string& name, const Motion& motion, const Earth& earth);
  /// Of every vessel that has something new since it was asked for this output.
  std::vector<std::string> reports(const std::string& output, double hz, const Earth& earth);

 private:
  static constexpr double kFastest_hz = 1000.0;  // of their messages: each report leaves with the first at its instant
  struct Vessel {
    std::uint32_t mmsi = 0;
    std::optional<Motion> motion;
    Turning turning;
    std::map<std::string, Pace> paces;  // by output
  };
  std::map<std::string, Vessel> vessels_;
};

}  // namespace ensonify::nav_out
