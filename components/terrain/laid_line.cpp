#include "components/terrain/laid_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/config/config_error.h"
#include "kernels/mesh/solids/line.h"
#include "kernels/mesh/solids/words.h"

namespace ensonify::source {
namespace {

using frames::Vec2;
using frames::Vec3;

constexpr double kWithin_m = 0.002;  // points of a section that leave it by no more are left out
constexpr double kSagitta = 0.02;    // of its sides, over its diameter
constexpr double kFinest_m = 0.02, kMostHeights = 200'000.0;
constexpr double kChainRadius = 0.5 * 3.6 / std::numbers::sqrt2;  // of links that lie leaning, over their wire

bool is_chain(const SceneObject& object) { return std::holds_alternative<solids::Chain>(object.solid); }

/// Of its middle line above the ground that it lies on.
double radius_m(const SceneObject& object) {
  const double diameter_m = solids::sizes_of(object.solid)[0];
  return is_chain(object) ? kChainRadius * diameter_m : 0.5 * diameter_m;
}

/// Places along a route: its corners, and between them evenly so far apart at most.
std::vector<double> places_along(const LaidRoute& route, double apart_m) {
  std::vector<double> along{0.0};
  for (std::size_t i = 1; i < route.through_enu_m.size(); ++i) {
    const double leg_m = (route.through_enu_m[i] - route.through_enu_m[i - 1]).norm(), from_m = along.back();
    const int pieces = std::max(1, static_cast<int>(std::ceil(leg_m / apart_m)));
    for (int k = 1; k <= pieces; ++k) along.push_back(from_m + leg_m * k / pieces);
  }
  return along;
}

double length_of(const LaidRoute& route) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < route.through_enu_m.size(); ++i)
    length_m += (route.through_enu_m[i] - route.through_enu_m[i - 1]).norm();
  return length_m;
}

/// Keeps what a line needs to stay within a distance of it (Douglas and Peucker).
void thin_out(const std::vector<Vec3>& line, std::size_t from, std::size_t to, std::vector<bool>& keep) {
  const Vec3 along = (line[to] - line[from]).normalized();
  double farthest_m = kWithin_m;
  std::size_t at = 0;
  for (std::size_t i = from + 1; i < to; ++i) {
    const Vec3 off = line[i] - line[from];
    if (const double away_m = (off - off.dot(along) * along).norm(); away_m > farthest_m) farthest_m = away_m, at = i;
  }
  if (at == 0) return;
  keep[at] = true;
  thin_out(line, from, at, keep);
  thin_out(line, at, to, keep);
}

}  // namespace

LaidLine::LaidLine(const SceneObject& section, const TerrainSource& ground) : route_(section.laid.value().route) {
  const auto refuse = [&](const std::string& why) {
    throw ConfigError({ConfigProblem{section.written, "objects." + section.name + ".laid.through_m", why}});
  };
  // Half as far apart as posts: between them heights are straight along a row only.
  const double apart_m = std::max({kFinest_m, 0.5 * ground.native_spacing_m(), length_of(*route_) / kMostHeights});
  along_m_ = places_along(*route_, apart_m);
  const Extent known = ground.extent();
  std::vector<double> ground_m;
  for (const double along_m : along_m_) {
    const Vec2 place = position_on(*route_, along_m);
    if (!known.contains(place))
      refuse(fmt::format(
          "leaves the terrain at ({:g}, {:g}) m; allowed is east {:.0f} to {:.0f}, north {:.0f} to {:.0f} m", place.x(),
          place.y(), known.west_m, known.east_m, known.south_m, known.north_m));
    ground_m.push_back(ground.height_m(place));
    if (!std::isfinite(ground_m.back()))
      refuse(fmt::format("crosses a hole of the terrain at ({:g}, {:g}) m; allowed is a way over ground", place.x(),
                         place.y()));
  }
  height_m_ = solids::laid_heights(along_m_, ground_m, route_->taut_m);
  const double raised_m = radius_m(section) * (1.0 - 2.0 * route_->buried);
  for (double& height : height_m_) height += raised_m;
}

Vec3 LaidLine::at(double along_m) const {
  const auto next = std::upper_bound(along_m_.begin() + 1, along_m_.end() - 1, along_m) - along_m_.begin();
  const auto i = static_cast<std::size_t>(next);
  const double share = std::clamp((along_m - along_m_[i - 1]) / (along_m_[i] - along_m_[i - 1]), 0.0, 1.0);
  const Vec2 place = position_on(*route_, along_m);
  return {place.x(), place.y(), height_m_[i - 1] + share * (height_m_[i] - height_m_[i - 1])};
}

solids::Surface LaidLine::surface(const SceneObject& section) const {
  const LaidSection& wanted = section.laid.value();
  std::vector<Vec3> line{at(wanted.from_m)};
  for (const double along_m : along_m_) {
    if (along_m > wanted.from_m && along_m < wanted.to_m) line.push_back(at(along_m));
  }
  line.push_back(at(wanted.to_m));
  const Vec3 origin = line.front();
  for (Vec3& place : line) place -= origin;
  std::vector<bool> keep(line.size(), false);
  keep.front() = keep.back() = true;
  thin_out(line, 0, line.size() - 1, keep);
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (keep[i]) kept.push_back(line[i]);
  }
  const double diameter_m = solids::sizes_of(section.solid)[0], sagitta_m = kSagitta * diameter_m;
  solids::Surface surface = is_chain(section) ? solids::chain_along(line, diameter_m, sagitta_m)
                                              : solids::rope_along(kept, diameter_m, sagitta_m);
  surface.mesh.origin_enu_m = origin;
  return surface;
}

}  // namespace ensonify::source
