#pragma once

#include <cmath>
#include <limits>

namespace ensonify::formats {

/// A quantity that a file holds as an integer: value = count * UnitsPerStep / StepsPerUnit, in the unit that the
/// field's name says. The highest positive count means "not known", as in every format here that has such fields.
template <class Count, int StepsPerUnit, int UnitsPerStep = 1>
struct FixedPoint {
  static constexpr Count kUnknown = std::numeric_limits<Count>::max();

  Count count = 0;

  /// NaN where it is not known.
  double value() const {
    if (count == kUnknown) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(count) * UnitsPerStep / StepsPerUnit;
  }

  /// The nearest count; "not known" for NaN and for what does not fit.
  static FixedPoint of(double value) {
    const double steps = std::round(value * StepsPerUnit / UnitsPerStep);
    const bool fits = steps >= static_cast<double>(std::numeric_limits<Count>::min()) &&
                      steps < static_cast<double>(std::numeric_limits<Count>::max());
    return {fits ? static_cast<Count>(steps) : kUnknown};
  }

  bool operator==(const FixedPoint&) const = default;
};

}  // namespace ensonify::formats
