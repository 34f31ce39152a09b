#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "components/formats/motion.h"
#include "components/formats/nmea/sentence.h"

/// Sentences of NMEA 0183 [NMEA0183] that give where a vehicle is, how it lies and moves, and how deep the water is.
/// Times are seconds of the UTC day; what a sentence leaves blank is not given.
namespace ensonify::nmea {

/// GGA of any talker, or RMC, which has neither height nor dilution. Quality 0: there is no fix, and the place means
/// nothing.
struct Fix {
  double time_s = 0.0;
  int quality = 0;
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double hdop = 0.0;  // 0: not given
  std::optional<double> height_above_geoid_m;
  std::optional<double> geoid_above_ellipsoid_m;
};

/// VTG, or the same of RMC: over ground.
struct Course {
  std::optional<double> true_course_rad;
  double speed_mps = 0.0;
};

struct MinimumFix {  // RMC
  Fix fix;           // quality 1, or 0 where its status warns
  std::optional<Course> course;
  std::optional<std::chrono::sys_days> date;
};

/// HDT, or THS with a mode that may be used.
struct Heading {
  double true_heading_rad = 0.0;
};

/// ROT: of the heading, to starboard.
struct TurnRate {
  double rate_radps = 0.0;
};

/// ZDA.
struct DateAndTime {
  double time_s = 0.0;
  std::chrono::sys_days date;
};

/// GST: standard deviations of the fix of that time.
struct FixAccuracy {
  double time_s = 0.0;
  double latitude_m = 0.0, longitude_m = 0.0;
  std::optional<double> height_m;
};

/// DPT, or DBT, which has no offset.
struct WaterDepth {
  double below_transducer_m = 0.0;
  std::optional<double> offset_m;  // from the transducer down to the keel if negative, up to the water line if positive
};

/// VBW: along the bow and to starboard, each where its status says that it is valid.
struct TwoSpeeds {
  std::optional<double> water_ahead_mps, water_starboard_mps;
  std::optional<double> ground_ahead_mps, ground_starboard_mps;
};

/// DTM: the datum of the fixes that follow ("W84").
struct Datum {
  std::string code;
};

/// PSXN,20: whether what follows in PSXN,23 is to be used.
struct MotionQuality {
  bool heave = true, roll_and_pitch = true, heading = true;
};

/// PASHR; PSAT,HPR; or PSXN,23, which has no time. Roll with port up, pitch with bow up, heave up; PSXN,23 counts heave
/// down, and is turned.
using formats::Motion;

using Navigation = std::variant<Fix, MinimumFix, Course, Heading, TurnRate, DateAndTime, FixAccuracy, WaterDepth,
                                TwoSpeeds, Datum, MotionQuality, Motion, Other, Empty, BadChecksum, Malformed>;

/// One line. Fields beyond those that are needed are not examined.
Navigation read_navigation(std::string_view line);

}  // namespace ensonify::nmea
