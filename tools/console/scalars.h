#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "messages/console.h"
#include "messages/value.h"

namespace ensonify::console {

/// Numbers of a message type that can be drawn over time: its fields, and what follows from them (heading, roll and
/// pitch of an attitude, speed of a velocity, depth of a position, ping rate of ping numbers). Angles are in degrees.
/// None for a type that is not known.
const std::vector<msg::ConsoleScalar>& scalars_of(std::string_view type);

/// The ping before, from which a rate follows.
struct LastPing {
  std::optional<std::int64_t> number;
  std::int64_t stamp_ns = 0;
};

/// A number of a message in the unit of its scalar; NaN: the message has none, or says that it is not valid.
double scalar_in(const msg::Value& message, std::string_view type, std::string_view field, LastPing& last);

}  // namespace ensonify::console
