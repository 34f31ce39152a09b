#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "components/formats/nmea/sentence.h"

/// Sentences of NMEA 0183 [NMEA0183] by which survey packages and plotters order an autopilot.
namespace ensonify::nmea {

/// Clockwise from true north, or from magnetic north.
struct Bearing {
  double rad = 0.0;
  bool magnetic = false;
};

/// HSC: the heading to steer.
struct HeadingOrder {
  Bearing heading;
};

/// APB, XTE or RMB: how far the vehicle is off the leg that it is to follow, and as far as the sentence says the leg's
/// direction: its own bearing (APB), or that of its end from the vehicle, and how far that is (RMB).
struct LegOrder {
  double off_m = 0.0;  // to starboard of the leg
  std::optional<Bearing> leg;
  std::optional<Bearing> to_end;
  double to_end_m = 0.0;
};

struct Warned {};  // one of these kinds with status V, or mode N: its source says that it is not to be used
using Steer = std::variant<HeadingOrder, LegOrder, Warned, Other, Empty, BadChecksum, Malformed>;

/// One line. Fields beyond those that are needed are not examined.
Steer read_steering(std::string_view line);

}  // namespace ensonify::nmea
