#pragma once

#include "kernels/base/frames/attitude.h"

namespace ensonify::frames {

/// A place on the WGS 84 ellipsoid, degrees (the edge of the system; inside, the world is ENU metres).
struct Geodetic {
  double latitude_deg = 0.0;   // north
  double longitude_deg = 0.0;  // east
};

/// The world's map: transverse Mercator centred at the scenario's origin, scale 1 [Karney2011].
///
/// x is east and y is grid north in metres from the origin; heights are not touched. Distances are too long by
/// x^2 / (2 R^2): 1.2 ppm at 10 km east. A place a quarter of the globe away is mapped but meaningless.
class LocalProjection {
 public:
  /// Throws std::invalid_argument unless -90 < latitude < 90 and -180 <= longitude <= 180.
  explicit LocalProjection(const Geodetic& origin);

  Vec2 enu_of(const Geodetic& place) const;
  Geodetic geodetic_of(const Vec2& position_enu_m) const;

  /// Bearing of grid north, clockwise from true north: true heading = grid heading + convergence.
  double convergence_rad(const Vec2& position_enu_m) const;

  const Geodetic& origin() const { return origin_; }

 private:
  Geodetic origin_;
  double origin_northing_m_;  // from the equator, along the central meridian
};

}  // namespace ensonify::frames
