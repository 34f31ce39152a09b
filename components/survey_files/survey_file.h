#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/formats/window.h"
#include "components/runtime/tool.h"
#include "components/survey_files/fixes.h"
#include "components/survey_files/ping.h"
#include "components/survey_files/survey.h"

/// What files of all formats share.
namespace ensonify::survey_files {

inline constexpr double kDegree = std::numbers::pi / 180.0;

/// What a motion sensor said.
struct Moved {
  std::int64_t unix_ns;
  float roll_deg, pitch_deg, heading_deg, heave_down_m;

  bool finite() const { return std::isfinite(roll_deg + pitch_deg + heading_deg + heave_down_m); }
};

/// Shows each datagram of a file. How many faults were passed over.
template <class Reader, class See>
std::uint64_t each_datagram(const std::string& file, const See& see) {
  formats::Window window(file);
  Reader reader(window);
  while (const auto datagram = interrupted() ? std::nullopt : reader.next()) see(*datagram);
  return reader.faults().count();
}

/// A sound speed that a file states. Throws UserError where it is none of water.
inline double checked_speed(const std::string& file, double speed_mps, const std::string& where) {
  constexpr double kSlowest_mps = refraction::SoundSpeedProfile::kSlowest_mps,
                   kFastest_mps = refraction::SoundSpeedProfile::kFastest_mps;
  if (speed_mps >= kSlowest_mps && speed_mps <= kFastest_mps) return speed_mps;
  throw UserError(fmt::format("{}: {} has a sound speed of {:g} m/s; allowed: {:.0f} to {:.0f} m/s", file, where,
                              speed_mps, kSlowest_mps, kFastest_mps));
}

/// A node of a profile, if it lies deeper than those before.
inline void add_node(const std::string& file, double depth_m, double speed_mps, std::vector<refraction::Knot>& knots) {
  const refraction::Knot knot{depth_m, checked_speed(file, speed_mps, fmt::format("its profile at {:g} m", depth_m))};
  if (std::isfinite(depth_m) && (knots.empty() || depth_m > knots.back().depth_m)) knots.push_back(knot);
}

/// The place on the map of what lies `away` of a place there: east and north, true.
frames::Vec2 on_map(const frames::LocalProjection& projection, const frames::Vec2& reference,
                    const frames::Vec2& away_true);

/// Where a placed sounding lies on the map and on the globe, of a vessel whose reference point is at `reference`.
inline void put_on_map(const frames::LocalProjection& projection, const frames::Pose& body,
                       const frames::Vec2& reference, const frames::Vec3& place_enu_m, Placed& placed) {
  const frames::Vec2 place = on_map(projection, reference, (place_enu_m - body.position_enu_m).head<2>());
  placed.place_enu_m = {place.x(), place.y(), place_enu_m.z()};
  placed.position = projection.geodetic_of(place);
}

}  // namespace ensonify::survey_files
