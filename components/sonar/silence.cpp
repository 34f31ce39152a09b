#include "components/sonar/silence.h"

#include <utility>

namespace ensonify {

bool Silence::pass_over(SimTime now, const std::string& cause) {
  if (!spell_) {
    spell_ = Spell{now, 0};
    kind_.clear();
  }
  ++spell_->passed_over;
  const std::string kind = cause.substr(0, cause.find_first_of("-0123456789"));
  return std::exchange(kind_, kind) != kind;
}

std::optional<Silence::Spell> Silence::end() { return std::exchange(spell_, std::nullopt); }

}  // namespace ensonify
