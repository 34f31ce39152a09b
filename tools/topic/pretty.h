#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "components/runtime/clock_client.h"
#include "messages/codec.h"
#include "messages/schema.h"

namespace ensonify::topic_tool {

/// A message for people, one line per field: "  range_m: 40 m". Units come from `type`, which may be null for types
/// that this program does not know. Arrays are abbreviated: type, shape, first and last elements, smallest and largest.
std::string message_text(const msg::Value& message, const msg::TypeInfo* type);

/// One value on one line, without its name: "40 m".
std::string value_text(const msg::Value& value, const std::string& unit);

/// The field at a path such as "position_enu_m.0", or null.
const msg::FieldInfo* find_field(const msg::TypeInfo* type, std::string_view path);

/// "4.2 MB", "17 kB", "512 B": powers of ten, for people.
std::string bytes_text(double bytes);

/// "100 Hz", "29.97 Hz", "at most 10 Hz on average" when the rate is not declared.
std::string rate_text(Rate rate);

}  // namespace ensonify::topic_tool
