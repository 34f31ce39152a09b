#include "kernels/instruments/sensors/gnss.h"

#include <algorithm>
#include <cmath>

namespace ensonify::sensors {
namespace {

enum Lane : std::uint64_t { kEast, kNorth, kUp, kDilution, kWhite };

}  // namespace

Gnss::Gnss(const GnssErrors& errors, const random::Stream& stream)
    : errors_(errors),
      stream_(stream),
      east_(1.0, errors.wander_s, stream, kEast),
      north_(1.0, errors.wander_s, stream, kNorth),
      up_(1.0, errors.wander_s, stream, kUp),
      dilution_(1.0, errors.hdop_wander_s, stream, kDilution),
      received_s_(errors.first_fix_s + errors.converge_s) {}  // the receiver has been on for long

GnssReading Gnss::measure(double antenna_above_water_m, bool jammed, double dt_s) {
  if (n_++ > 0) {
    east_.advance(dt_s, stream_, n_, kEast);
    north_.advance(dt_s, stream_, n_, kNorth);
    up_.advance(dt_s, stream_, n_, kUp);
    dilution_.advance(dt_s, stream_, n_, kDilution);
    received_s_ += dt_s;
  }
  if (jammed || antenna_above_water_m < errors_.washed_depth_m) received_s_ = 0.0;
  constexpr double kRounding_s = 1e-9;
  if (received_s_ < errors_.first_fix_s - kRounding_s || received_s_ == 0.0) return {};

  const bool best = received_s_ >= errors_.first_fix_s + errors_.converge_s - kRounding_s;
  const FixErrors& e = best ? errors_.fix : errors_.degraded;
  GnssReading reading;
  reading.quality = best ? errors_.best : errors_.while_degraded;
  reading.hdop = errors_.hdop * std::max(0.5, 1.0 + errors_.hdop_wander * dilution_.value());
  const frames::Vec3 white(e.horizontal_m * stream_.normal(n_, kWhite), e.horizontal_m * stream_.normal(n_, kWhite + 1),
                           e.vertical_m * stream_.normal(n_, kWhite + 2));
  const frames::Vec3 slow(e.wander_horizontal_m * east_.value(), e.wander_horizontal_m * north_.value(),
                          e.wander_vertical_m * up_.value());
  reading.error_enu_m = reading.hdop * (white + slow);
  const double horizontal = reading.hdop * std::hypot(e.horizontal_m, e.wander_horizontal_m);
  reading.sigma_enu_m = {horizontal, horizontal, reading.hdop * std::hypot(e.vertical_m, e.wander_vertical_m)};
  return reading;
}

}  // namespace ensonify::sensors
