#pragma once

#include <cstdint>
#include <string>

#include "components/logger/config.h"
#include "kernels/base/frames/local_projection.h"
#include "messages/navigation.h"

namespace ensonify::logger {

/// What the vessel's instruments know at the time of an estimate: what every format says of navigation and attitude.
struct Moment {
  std::int64_t stamp_ns = 0, unix_ns = 0;
  frames::Geodetic reference;   // the reference point
  frames::Geodetic water_line;  // Vessel::horizontal_origin_enu_m()
  double roll_deg = 0.0, pitch_deg = 0.0;
  double heading_deg = 0.0;  // true, 0 to 360
  double heave_down_m = 0.0;
  double speed_mps = 0.0, course_deg = 0.0;  // over ground, true
  double north_mps = 0.0, east_mps = 0.0, down_mps = 0.0;
  double fix_quality_m = 0.0;
  double height_m = 0.0;  // of the last fix above the ellipsoid
  // A position, or the time of day, is due now, at its rate.
  bool position_due = false, clock_due = false;
  std::string gga;  // of the reference point, where a position is due; without $ and line end
};

/// `fix` is the last one. What is due the caller sets.
Moment moment_of(const msg::Estimate& estimate, const msg::Position& fix, double heave_down_m,
                 const LoggerConfig& config, const frames::LocalProjection& world);

/// Halfway between two moments that follow each other; what is due is what is due at the later one, but for its
/// sentence.
Moment between(const Moment& earlier, const Moment& later);

/// The sentence of a moment's position.
std::string gga_of(const Moment& moment, const msg::Position& fix, SimulatedMarks marks);

}  // namespace ensonify::logger
