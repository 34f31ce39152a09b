#pragma once

#include <optional>
#include <string>
#include <variant>

#include "messages/schema.h"
#include "messages/value.h"

/// A value inside a message, named by a path: keys and indices between dots ("position_enu_m.2"), the name of a list's
/// element ("counters.pings.count"), and at the end of a path to an array or a list of numbers one of
/// min, max, mean, any (1 if one is not 0), all (1 if none is 0), nonzero (how many are not 0), size.
namespace ensonify::expect {

/// A number, or a text (a boolean is "true" or "false").
using Scalar = std::variant<double, std::string>;

/// The value at the path, or nothing: no such element, or the reduction of nothing. NaN elements do not count in
/// min, max and mean.
std::optional<Scalar> value_at(const msg::Value& message, const std::string& path);

/// Reason that no message of this type has a single value at the path; "" if one can.
std::string path_fault(const msg::TypeInfo& type, const std::string& path);

/// As people read it: 3.5, "done".
std::string text_of(const Scalar& value);

}  // namespace ensonify::expect
