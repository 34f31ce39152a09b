#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "components/runtime/sim_time.h"

namespace ensonify {

/// A spell without pings: what of it the log should say. Health says the cause all the while.
class Silence {
 public:
  struct Spell {
    SimTime since{0};
    std::int64_t passed_over = 0;  // beats
  };

  /// A beat passes without a ping. Whether this is news: the spell begins, or its cause is another one; the same with
  /// other numbers is not.
  bool pass_over(SimTime now, const std::string& cause);
  /// A ping goes out: the spell that it ends, if there is one.
  std::optional<Spell> end();

 private:
  std::optional<Spell> spell_;
  std::string kind_;  // of the cause: its words up to the first number
};

}  // namespace ensonify
