#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "components/errors/exit_error.h"
#include "tools/georeference/fixes.h"
#include "tools/georeference/ping.h"
#include "tools/georeference/survey.h"

/// What files of all formats share.
namespace ensonify::georeference_tool {

inline constexpr double kDegree = std::numbers::pi / 180.0;

/// What a motion sensor said.
struct Moved {
  std::int64_t unix_ns;
  float roll_deg, pitch_deg, heading_deg, heave_down_m;

  bool finite() const { return std::isfinite(roll_deg + pitch_deg + heading_deg + heave_down_m); }
};

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

/// Where a vessel with a place on the map has what lies `away` of it: east and north, true.
frames::Geodetic position_of(const frames::LocalProjection& projection, const frames::Vec2& reference,
                             const frames::Vec2& away_true);

}  // namespace ensonify::georeference_tool
