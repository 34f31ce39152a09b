#pragma once

#include <optional>
#include <string>

#include "components/config/config_error.h"
#include "components/expect/field.h"

namespace ensonify {
class ConfigReader;
}

namespace ensonify::expect {

/// `{field: state, equals: done}`: a field and what its value must be. Several comparisons must all hold.
struct Condition {
  std::string field;
  ConfigPlace place;                  // of the field's name in the user's file
  std::optional<std::string> equals;  // as written; a number compares as a number
  std::optional<std::string> differs;
  std::optional<double> above, below, at_least, at_most;

  /// Reads the keys of a map; a condition without a comparison is a problem.
  static Condition read(ConfigReader& from);

  /// A text never is above or below anything, and NaN satisfies nothing but `not`.
  bool holds(const Scalar& value) const;
  /// "state = done".
  std::string text() const;
};

}  // namespace ensonify::expect
