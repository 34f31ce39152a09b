#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "components/formats/nmea/sentence.h"

/// Sentences of NMEA 0183 [NMEA0183] that give where a vehicle is and how it lies. Times are seconds of the UTC day.
namespace ensonify::nmea {

/// GGA of any talker. Quality 0: there is no fix, and the place means nothing.
struct Fix {
  double time_s = 0.0;
  int quality = 0;
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double hdop = 0.0;  // 0: not given
  std::optional<double> height_above_geoid_m;
};

/// HDT of any talker.
struct Heading {
  double true_heading_rad = 0.0;
};

/// PASHR, or PSXN,23, which has no time. Signs are those that both use: roll with port up, pitch with bow up, heave up.
struct Motion {
  std::optional<double> time_s;
  std::optional<double> true_heading_rad;
  double roll_rad = 0.0, pitch_rad = 0.0, heave_m = 0.0;
};

using Navigation = std::variant<Fix, Heading, Motion, Other, Empty, BadChecksum, Malformed>;

/// One line. Fields beyond those that are needed are not examined.
Navigation read_navigation(std::string_view line);

}  // namespace ensonify::nmea
