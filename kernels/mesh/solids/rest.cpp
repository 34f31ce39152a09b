#include "kernels/mesh/solids/rest.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "kernels/mesh/solids/facet.h"

namespace ensonify::solids {
namespace {

using frames::Vec2;
using frames::Vec3;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kFirstTilt_rad = 8.0 * kDegree, kFinestTilt_rad = 0.01 * kDegree;
constexpr int kMostTilts = 400;

/// Height of the origin at which the lowest place touches the ground.
double touching_m(std::span<const Vec3> places_m, const Eigen::Matrix3d& turn, const Vec2& position_m,
                  const GroundPatch& ground) {
  double height_m = -std::numeric_limits<double>::infinity();
  for (const Vec3& place : places_m) {
    const Vec3 at = turn * place;
    height_m = std::max(height_m, ground.at(position_m + at.head<2>()) - at.z());
  }
  return height_m;
}

}  // namespace

Vec3 centre_of_mass(const progressive::TriangleMesh& mesh) {
  Vec3 by_volume = Vec3::Zero(), by_area = Vec3::Zero();
  double volume = 0.0, area = 0.0;
  for (const auto& [i, j, k] : mesh.triangle) {
    const Vec3 a = mesh.vertex_m[i].cast<double>(), b = mesh.vertex_m[j].cast<double>(),
               c = mesh.vertex_m[k].cast<double>();
    const double six = a.dot(b.cross(c)), twice = (b - a).cross(c - a).norm();
    by_volume += six * (a + b + c) / 4.0, volume += six;
    by_area += twice * (a + b + c) / 3.0, area += twice;
  }
  const double size = std::sqrt(area);
  const Vec3 centre = std::abs(volume) > 1e-9 * size * size * size ? Vec3(by_volume / volume) : Vec3(by_area / area);
  return mesh.origin_enu_m + centre;
}

std::vector<Vec3> places_of(const Surface& surface, double apart_m) {
  std::vector<Vec3> places;
  for (const Eigen::Vector3f& vertex : surface.mesh.vertex_m)
    places.push_back(surface.mesh.origin_enu_m + vertex.cast<double>());
  for (std::size_t t = 0; t < surface.mesh.triangle.size(); ++t) {
    const Facet whole = facet_of(surface, t);
    split_facet(whole, apart_m, [&](const Facet& part) {
      if (part.corners != whole.corners) places.insert(places.end(), part.corners.begin(), part.corners.end());
    });
  }
  const auto less = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::ranges::sort(places, less);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

double GroundPatch::at(const Vec2& place_m) const {
  const Vec2 cell = (place_m - corner_m) / spacing_m;
  const auto east = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::floor(cell.x())), 0, height_m.cols() - 2);
  const auto north = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::floor(cell.y())), 0, height_m.rows() - 2);
  const double x = cell.x() - static_cast<double>(east), y = cell.y() - static_cast<double>(north);
  return (1.0 - y) * ((1.0 - x) * height_m(north, east) + x * height_m(north, east + 1)) +
         y * ((1.0 - x) * height_m(north + 1, east) + x * height_m(north + 1, east + 1));
}

Rest at_rest(std::span<const Vec3> places_m, const Vec3& centre_m, const Eigen::Matrix3d& upright,
             const Vec2& position_m, const GroundPatch& ground) {
  Rest best{upright, touching_m(places_m, upright, position_m, ground)};
  double lowest_m = best.height_m + (upright * centre_m).z();
  const auto lower = [&](const Eigen::Matrix3d& turn) {
    const double height_m = touching_m(places_m, turn, position_m, ground);
    const double centre_height_m = height_m + (turn * centre_m).z();
    if (centre_height_m >= lowest_m - 1e-9) return false;
    best = {turn, height_m};
    lowest_m = centre_height_m;
    return true;
  };
  int left = kMostTilts;
  for (double tilt_rad = kFirstTilt_rad; tilt_rad >= kFinestTilt_rad; tilt_rad *= 0.5) {
    bool moved = true;
    while (moved && left > 0) {
      moved = false;
      for (int way = 0; way < 8 && !moved; ++way, --left) {  // about eight level axes
        const double axis_rad = way * 0.25 * std::numbers::pi;
        const Vec3 axis(std::cos(axis_rad), std::sin(axis_rad), 0.0);
        moved = lower(Eigen::AngleAxisd(tilt_rad, axis).toRotationMatrix() * best.turn);
      }
    }
  }
  return best;
}

}  // namespace ensonify::solids
