#include "kernels/base/frames/local_projection.h"

#include <GeographicLib/Constants.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ensonify::frames {
namespace {

/// Krueger's series to the sixth order [Karney2011]: elliptic functions, exact everywhere, take ten times as long.
const GeographicLib::TransverseMercator& map() {
  static const GeographicLib::TransverseMercator wgs84(GeographicLib::Constants::WGS84_a(),
                                                       GeographicLib::Constants::WGS84_f(), 1.0);
  return wgs84;
}

double northing_m(const Geodetic& place) {
  double x_m = 0.0, y_m = 0.0;
  map().Forward(place.longitude_deg, place.latitude_deg, place.longitude_deg, x_m, y_m);
  return y_m;
}

}  // namespace

LocalProjection::LocalProjection(const Geodetic& origin) : origin_(origin), origin_northing_m_(0.0) {
  if (!(std::abs(origin.latitude_deg) < 90.0) || !(std::abs(origin.longitude_deg) <= 180.0)) {
    throw std::invalid_argument("the origin must have -90 < latitude < 90 and -180 <= longitude <= 180 degrees");
  }
  origin_northing_m_ = northing_m(origin);
}

Vec2 LocalProjection::enu_of(const Geodetic& place) const {
  double x_m = 0.0, y_m = 0.0;
  map().Forward(origin_.longitude_deg, place.latitude_deg, place.longitude_deg, x_m, y_m);
  return {x_m, y_m - origin_northing_m_};
}

Geodetic LocalProjection::geodetic_of(const Vec2& position_enu_m) const {
  Geodetic place;
  map().Reverse(origin_.longitude_deg, position_enu_m.x(), position_enu_m.y() + origin_northing_m_, place.latitude_deg,
                place.longitude_deg);
  return place;
}

double LocalProjection::convergence_rad(const Vec2& position_enu_m) const {
  double latitude_deg = 0.0, longitude_deg = 0.0, convergence_deg = 0.0, scale = 0.0;
  map().Reverse(origin_.longitude_deg, position_enu_m.x(), position_enu_m.y() + origin_northing_m_, latitude_deg,
                longitude_deg, convergence_deg, scale);
  return convergence_deg * std::numbers::pi / 180.0;
}

}  // namespace ensonify::frames
