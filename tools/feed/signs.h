#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernels/instruments/regression/slope.h"
#include "tools/feed/examine.h"

/// What physics says of the signs of a feed's motion.
namespace ensonify::feed_doctor {

struct Sign {
  enum class Is { kRight, kReversed, kUnknown };

  std::string of;  // "roll", "heave"
  Is is = Is::kUnknown;
  std::optional<regression::Slope> slope;
  std::string by;   // what was compared
  std::string why;  // it is not known
};

/// An antenna above the roll centre goes to starboard as the port side rises, by its height times the sine of the roll.
/// What sways with the roll beside it is in the slope too: a wave that carries the whole vessel moves it by its length
/// / 2 pi for each radian of its own slope, 16 m in waves of 8 s. With pitch that is as large as the antenna's way, so
/// its sign is not judged. Heave rises with the height of the fixes, and is opposite to a vertical acceleration.
std::vector<Sign> signs_of(const Findings& found);

}  // namespace ensonify::feed_doctor
