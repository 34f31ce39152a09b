#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/config/parameters.h"
#include "components/runtime/sim_time.h"
#include "kernels/vehicle/motion/hydrodynamics.h"
#include "messages/actuators.h"
#include "messages/motion.h"

namespace ensonify {

/// One of those who may steer a vehicle: a process with a topic `command` or `actuators`.
struct PilotKeys {
  enum class By { kCommand, kActuators };

  std::string name;
  static constexpr auto kNamedBy = &PilotKeys::name;
  std::optional<double> timeout_s;
  bool returns = true;
  By by = By::kCommand;

  static void parameters(auto& self, auto&& visit) {
    visit("timeout_s", "s", in(0.1, 1e6),
          "time without a command that is obeyed, of sim time, after which the next one steers; left out: never",
          self.timeout_s);
    visit("returns", "", any(),
          "return of one that was silent, once its commands have come for timeout_s without a gap", self.returns);
    visit("by", "", one_of({{"command", By::kCommand}, {"actuators", By::kActuators}}),
          "topic of its orders: command, to the vehicle's helm, or actuators, to propellers and fins themselves",
          self.by);
  }
};

/// To stop where it is.
struct Stop {};
using Order = std::variant<msg::Guidance, msg::Actuators, Stop>;

/// Why a command is refused: for_another_vehicle, not_finite, out_of_range or, of actuators, of_other_actuators when
/// there are more or fewer of them; empty: it may be obeyed.
std::string refusal_of(const msg::Guidance& guidance, const std::string& vehicle);
std::string refusal_of(const msg::Actuators& order, const std::string& vehicle,
                       const motion::HydrodynamicParameters& body);

/// Who of several pilots steers: the first of them, in their order, that is heard and has not handed the vehicle back.
class Pilots {
 public:
  explicit Pilots(const std::vector<PilotKeys>& pilots);

  /// A command of one of them, which may be obeyed.
  void take(SimTime now, const std::string& pilot, const msg::Guidance& guidance) {
    take(now, pilot, guidance, guidance.hand_back);
  }
  void take(SimTime now, const std::string& pilot, const msg::Actuators& order) {
    take(now, pilot, order, order.hand_back);
  }
  /// Looks who steers now. True when that has changed.
  bool update(SimTime now);

  /// Name of who steers; empty: nobody.
  const std::string& steered_by() const { return steered_by_; }
  /// commands, silent or hand_back: why it last changed.
  const std::string& why() const { return why_; }
  /// What is to be obeyed that was not yet. When nobody steers any more: to stop.
  std::optional<Order> take_command();

 private:
  struct Pilot {
    PilotKeys keys;
    std::optional<SimTime> heard_at, heard_since;  // last, and first without a gap
    std::optional<Order> newest;                   // not yet obeyed
    bool was_silent = false, handed_back = false;

    bool silent(SimTime now) const;
    bool may_steer(SimTime now) const;
  };
  void take(SimTime now, const std::string& pilot, Order order, bool hand_back);
  const Pilot* first(SimTime now) const;

  std::vector<Pilot> pilots_;
  std::string steered_by_, why_;
  std::optional<Order> obeyed_;  // last
  bool to_stop_ = false;
};

}  // namespace ensonify
