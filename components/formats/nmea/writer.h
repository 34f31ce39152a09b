#pragma once

#include <string>
#include <string_view>

#include "components/formats/nmea/navigation.h"

/// Sentences of NMEA 0183 [NMEA0183] as instruments send them, from the structs that reading gives: with `$`, sum and
/// CR LF. `talker` says what kind of instrument speaks: GP, GN, IN, HE.
///
/// Values are rounded to the last digit that is written: angles to 0.01 degree, heights, depths and heave to the
/// millimetre or, where sentences have no more, the centimetre, times to the millisecond, places to a ten millionth of
/// a minute (0.2 mm).
namespace ensonify::nmea {

/// A `$`, the body, its sum and CR LF.
std::string framed(std::string_view body);

/// GGA's quality of a system that does not state it: what has such a standard deviation.
int quality_of(double sigma_horizontal_m);

/// With 12 satellites, which a Fix does not have. Quality 0: all else is blank. `time_decimals`: 2 or 3.
std::string gga(std::string_view talker, const Fix& fix, int time_decimals = 3);
std::string gst(std::string_view talker, const FixAccuracy& accuracy);
std::string zda(std::string_view talker, const DateAndTime& time);
std::string vtg(std::string_view talker, const Course& course);
std::string hdt(std::string_view talker, const Heading& heading);
std::string rot(std::string_view talker, const TurnRate& rate);
std::string dpt(std::string_view talker, const WaterDepth& depth);
std::string dbt(std::string_view talker, const WaterDepth& depth);

/// Standard deviations that PASHR states, where they are known.
struct MotionAccuracy {
  std::optional<double> roll_rad, pitch_rad, heading_rad;
};
/// Of a motion with a time. What is not given is blank. `fix_quality` is GGA's.
std::string pashr(const Motion& motion, const MotionAccuracy& accuracy, int fix_quality);
std::string psxn_20(const MotionQuality& quality);
std::string psxn_23(const Motion& motion);

}  // namespace ensonify::nmea
