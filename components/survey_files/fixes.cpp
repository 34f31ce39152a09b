#include "components/survey_files/fixes.h"

#include <cmath>
#include <iterator>

namespace ensonify::survey_files {

bool Fixes::is_known(const frames::Geodetic& place) {
  const bool on_globe = std::abs(place.latitude_deg) < 90.0 && std::abs(place.longitude_deg) <= 180.0;
  return on_globe && !(place.latitude_deg == 0.0 && place.longitude_deg == 0.0);
}

void Fixes::add(std::int64_t unix_ns, const frames::Geodetic& place) {
  if (is_known(place)) fixes_[unix_ns] = place;
}

const frames::LocalProjection& Fixes::projection() const {
  if (!projection_) {
    frames::Geodetic origin = fixes_.begin()->second;
    if (origin.longitude_deg == 180.0) origin.longitude_deg = -180.0;
    projection_.emplace(origin);
  }
  return *projection_;
}

frames::Vec2 Fixes::enu_at(std::int64_t unix_ns) const {
  const auto after = fixes_.lower_bound(unix_ns);
  if (after == fixes_.end()) return projection().enu_of(fixes_.rbegin()->second);
  const frames::Vec2 later = projection().enu_of(after->second);
  if (after == fixes_.begin()) return later;
  const auto before = std::prev(after);
  const frames::Vec2 earlier = projection().enu_of(before->second);
  const double part = static_cast<double>(unix_ns - before->first) / static_cast<double>(after->first - before->first);
  return earlier + part * (later - earlier);
}

}  // namespace ensonify::survey_files
