#pragma once

#include <map>
#include <vector>

#include "components/logger/format.h"
#include "messages/declarations.h"
#include "messages/sonar.h"

namespace ensonify::logger {

/// Joins the messages of a sidescan's transmissions into pings.
class SidescanAssembly {
 public:
  explicit SidescanAssembly(const msg::HeadDeclaration& head);

  void take(const msg::Ping& ping);
  void take(const msg::BottomTrack& bottom);

  /// Pings of which all transmissions are there, and those that a later one has overtaken; in their order. To be called
  /// when the inputs of a time are complete.
  std::vector<SidescanPing> complete();

 private:
  struct Parts {
    std::map<std::size_t, msg::Ping> transmissions;  // by their number in the declaration
    std::optional<double> altitude_m;
  };
  std::vector<double> frequencies_hz_;
  std::map<std::int64_t, Parts> pings_;  // by number
};

}  // namespace ensonify::logger
