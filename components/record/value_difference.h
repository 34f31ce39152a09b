#pragma once

#include <optional>
#include <string>

#include "messages/value.h"

namespace ensonify::record {

/// The first place at which two messages differ, in the order of the first one's fields.
struct ValueDifference {
  std::string field;  // "position_enu_m.2", "amplitude_upa[3,17]"
  std::string a;      // as text; "missing" where only the other has it
  std::string b;
};

/// Nothing if the two are equal bit by bit.
std::optional<ValueDifference> first_difference(const msg::Value& a, const msg::Value& b);

}  // namespace ensonify::record
