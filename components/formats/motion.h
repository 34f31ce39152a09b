#pragma once

#include <optional>

namespace ensonify::formats {

/// What a motion sensor says at one time, whatever its format. What it leaves blank is not given: never zero.
struct Motion {
  std::optional<double> time_s;  // of the UTC day; not given: the time of arrival counts
  std::optional<double> true_heading_rad;
  std::optional<double> roll_rad;   // port up
  std::optional<double> pitch_rad;  // bow up
  std::optional<double> heave_m;    // up
  bool usable = true;               // false: the sensor says that it is not to be used
};

}  // namespace ensonify::formats
