#pragma once

namespace ensonify::formats {

inline constexpr double kDay_s = 86'400.0;

/// From one time of day to another, the short way: -12 h to 12 h. 23:59:60 is a second of its own where the clock would
/// stand still or go back without it: from 23:59:60 to 00:00:00 is 1 s. To 00:00:01 it is 1 s too: a sender that gives
/// no 00:00:00 has rounded 59.999 up.
double time_of_day_step_s(double from_s, double to_s);

}  // namespace ensonify::formats
