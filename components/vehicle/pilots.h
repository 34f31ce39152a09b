#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "components/config/parameters.h"
#include "components/runtime/sim_time.h"
#include "messages/motion.h"

namespace ensonify {

/// One of those who may steer a vehicle: a process with a topic `command`.
struct PilotKeys {
  std::string name;
  static constexpr auto kNamedBy = &PilotKeys::name;
  std::optional<double> timeout_s;
  bool returns = true;

  static void parameters(auto& self, auto&& visit) {
    visit("timeout_s", "s", in(0.1, 1e6),
          "time without a command that is obeyed, of sim time, after which the next one steers; left out: never",
          self.timeout_s);
    visit("returns", "", any(),
          "return of one that was silent, once its commands have come for timeout_s without a gap", self.returns);
  }
};

/// Why a command is refused: for_another_vehicle, not_finite or out_of_range; empty: it may be obeyed.
std::string refusal_of(const msg::Guidance& guidance, const std::string& vehicle);

/// Who of several pilots steers: the first of them, in their order, that is heard and has not handed the vehicle back.
class Pilots {
 public:
  explicit Pilots(const std::vector<PilotKeys>& pilots);

  /// A command of one of them, which may be obeyed.
  void take(SimTime now, const std::string& pilot, const msg::Guidance& guidance);
  /// Looks who steers now. True when that has changed.
  bool update(SimTime now);

  /// Name of who steers; empty: nobody.
  const std::string& steered_by() const { return steered_by_; }
  /// commands, silent or hand_back: why it last changed.
  const std::string& why() const { return why_; }
  /// What is to be obeyed that was not yet. When nobody steers any more: to stop.
  std::optional<msg::Guidance> take_command();

 private:
  struct Pilot {
    PilotKeys keys;
    std::optional<SimTime> heard_at, heard_since;  // last, and first without a gap
    std::optional<msg::Guidance> newest;           // not yet obeyed
    bool was_silent = false, handed_back = false;

    bool silent(SimTime now) const;
    bool may_steer(SimTime now) const;
  };
  const Pilot* first(SimTime now) const;

  std::vector<Pilot> pilots_;
  std::string steered_by_, why_;
  std::optional<msg::Guidance> obeyed_;  // last
  bool to_stop_ = false;
};

}  // namespace ensonify
