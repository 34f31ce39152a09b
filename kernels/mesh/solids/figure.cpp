#include "kernels/mesh/solids/figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::solids {
namespace {

using frames::Vec3;

constexpr double kQuarter = 0.5 * std::numbers::pi;

Part at(const Solid& solid, const Vec3& middle_m) { return {solid, Eigen::Isometry3d(Eigen::Translation3d(middle_m))}; }

/// Turned about an axis of the figure before it is moved there.
Part turned_at(const Solid& solid, const Vec3& middle_m, double angle_rad, const Vec3& axis) {
  Part part = at(solid, middle_m);
  part.pose.rotate(Eigen::AngleAxisd(angle_rad, axis));
  return part;
}

/// A round bar from one place to another.
Part bar(const Vec3& from_m, const Vec3& to_m, double diameter_m) {
  Part part = at(Cylinder{diameter_m, (to_m - from_m).norm()}, 0.5 * (from_m + to_m));
  part.pose.rotate(Eigen::Quaterniond::FromTwoVectors(Vec3::UnitY(), to_m - from_m));
  return part;
}

/// Two stiles along y, and rungs 0.3 m apart or less.
std::vector<Part> ladder(const Vec3& size_m) {
  const double stile_m = size_m.z(), apart_m = 0.5 * (size_m.x() - stile_m), length_m = size_m.y();
  std::vector<Part> parts;
  for (const double side : {-1.0, 1.0}) parts.push_back(at(Box{{stile_m, length_m, stile_m}}, {side * apart_m, 0, 0}));
  const int rungs = std::max(2, static_cast<int>(std::ceil(length_m / 0.3)));
  for (int i = 0; i < rungs; ++i) {
    const double y_m = length_m * ((i + 0.5) / rungs - 0.5);
    parts.push_back(bar({-apart_m, y_m, 0}, {apart_m, y_m, 0}, 0.6 * stile_m));
  }
  return parts;
}

/// The twelve edges of a cuboid as bars, and two bars across each of its long faces.
std::vector<Part> trap(const Vec3& size_m) {
  const double bar_m = 0.06 * size_m.minCoeff();
  const Vec3 half = 0.5 * (size_m - Vec3::Constant(bar_m));
  std::vector<Part> parts;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-1.0, 1.0}) {
      parts.push_back(bar({-half.x(), a * half.y(), b * half.z()}, {half.x(), a * half.y(), b * half.z()}, bar_m));
      parts.push_back(bar({a * half.x(), -half.y(), b * half.z()}, {a * half.x(), half.y(), b * half.z()}, bar_m));
      parts.push_back(bar({a * half.x(), b * half.y(), -half.z()}, {a * half.x(), b * half.y(), half.z()}, bar_m));
    }
    for (const double y : {-1.0 / 3.0, 1.0 / 3.0}) {
      parts.push_back(bar({a * half.x(), y * half.y(), -half.z()}, {a * half.x(), y * half.y(), half.z()}, bar_m));
      parts.push_back(bar({-half.x(), y * half.y(), a * half.z()}, {half.x(), y * half.y(), a * half.z()}, bar_m));
    }
  }
  return parts;
}

/// A shank along y, a stock across its north end, and two flukes that lean from the crown at its south end.
std::vector<Part> anchor(const Vec3& size_m) {
  const double bar_m = 0.06 * size_m.y(), half_m = 0.5 * (size_m.y() - bar_m);
  const double stock_m = 0.5 * size_m.x() - 0.5 * bar_m;
  std::vector<Part> parts{bar({0, -half_m, 0}, {0, half_m, 0}, bar_m),
                          bar({-stock_m, 0.8 * half_m, 0}, {stock_m, 0.8 * half_m, 0}, 0.7 * bar_m),
                          bar({-0.35 * size_m.x(), -half_m, 0}, {0.35 * size_m.x(), -half_m, 0}, 1.3 * bar_m)};
  const double lean_rad = std::asin(std::min(0.9, 0.8 * size_m.z() / (0.5 * size_m.y())));
  for (const double side : {-1.0, 1.0}) {
    const Vec3 middle(side * 0.25 * size_m.x(), -half_m + 0.25 * size_m.y() * std::cos(lean_rad), 0.0);
    parts.push_back(
        turned_at(Box{{0.16 * size_m.x(), 0.5 * size_m.y(), 0.5 * bar_m}}, middle, lean_rad, Vec3::UnitX()));
  }
  return parts;
}

/// From below: a sinker of side y, a rope, and a buoy of diameter x.
std::vector<Part> mooring(const Vec3& size_m) {
  const double bottom_m = -0.5 * size_m.z(), sinker_m = size_m.y(), buoy_m = size_m.x();
  const double rope_m = std::min(0.1 * buoy_m, 0.03);
  return {at(Box{{sinker_m, sinker_m, 0.5 * sinker_m}}, {0, 0, bottom_m + 0.25 * sinker_m}),
          bar({0, 0, bottom_m + 0.25 * sinker_m}, {0, 0, -bottom_m - 0.5 * buoy_m}, rope_m),
          at(Sphere{buoy_m}, {0, 0, -bottom_m - 0.5 * buoy_m})};
}

/// On the back, the head to the north: x across the shoulders, y tall, z from chest to back.
std::vector<Part> person(const Vec3& size_m) {
  const double tall_m = size_m.y(), wide_m = size_m.x(), deep_m = size_m.z();
  const double head_m = std::min(deep_m, 0.13 * tall_m), leg_m = 0.6 * deep_m, arm_m = 0.4 * deep_m;
  std::vector<Part> parts{at(Sphere{head_m}, {0, 0.5 * (tall_m - head_m), 0}),
                          at(Cylinder{0.4 * head_m, 0.1 * tall_m}, {0, 0.36 * tall_m, 0}),
                          at(Box{{wide_m - 2.0 * arm_m, 0.3 * tall_m, deep_m}}, {0, 0.2 * tall_m, 0})};
  for (const double side : {-1.0, 1.0}) {
    const double leg_x_m = side * 0.25 * wide_m, arm_x_m = side * 0.5 * (wide_m - arm_m);
    parts.push_back(at(Cylinder{leg_m, 0.56 * tall_m}, {leg_x_m, -0.22 * tall_m, 0}));
    parts.push_back(at(Cylinder{arm_m, 0.4 * tall_m}, {arm_x_m, 0.14 * tall_m, 0}));
  }
  return parts;
}

/// A hull with a transom to the south and a sharp bow to the north, and a cabin.
std::vector<Part> boat(const Vec3& size_m) {
  const double beam_m = size_m.x(), length_m = size_m.y(), hull_m = 0.6 * size_m.z();
  const double stern_m = 0.65 * length_m, bow_m = length_m - stern_m, z_m = 0.5 * (hull_m - size_m.z());
  std::vector<Part> parts{
      at(Box{{beam_m, stern_m, hull_m}}, {0, 0.5 * (stern_m - length_m), z_m}),
      at(Box{{0.6 * beam_m, 0.3 * length_m, size_m.z() - hull_m}}, {0, -0.1 * length_m, 0.5 * hull_m})};
  // A ramp on its side is half of the bow: its foot to the north, its back along the keel's line.
  for (const double side : {-1.0, 1.0}) {
    Part half = at(Wedge{{hull_m, bow_m, 0.5 * beam_m}}, {side * 0.25 * beam_m, 0.5 * (length_m - bow_m), z_m});
    half.pose.rotate(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()));
    half.pose.rotate(Eigen::AngleAxisd(-side * kQuarter, Vec3::UnitY()));
    parts.push_back(half);
  }
  return parts;
}

/// A fuselage along y with its nose to the north, wings, tailplane and fin.
std::vector<Part> aircraft(const Vec3& size_m) {
  const double span_m = size_m.x(), length_m = size_m.y(), body_m = std::min(0.5 * size_m.z(), 0.3 * length_m);
  const double z_m = 0.5 * (body_m - size_m.z()), thick_m = 0.12 * body_m;
  const double fin_m = size_m.z() - 0.5 * body_m;
  return {at(Shell{body_m, length_m}, {0, 0, z_m}),
          at(Box{{span_m, 0.18 * length_m, thick_m}}, {0, 0.08 * length_m, z_m}),
          at(Box{{0.35 * span_m, 0.1 * length_m, thick_m}}, {0, -0.44 * length_m, z_m}),
          at(Box{{thick_m, 0.12 * length_m, fin_m}}, {0, -0.43 * length_m, z_m + 0.5 * fin_m})};
}

/// A hub along y, and four blades that are turned by 30 degrees against the disc.
std::vector<Part> propeller(const Vec3& size_m) {
  const double across_m = std::min(size_m.x(), size_m.z()), hub_m = 0.22 * across_m, blade_m = 0.5 * across_m;
  std::vector<Part> parts{at(Cylinder{hub_m, size_m.y()}, Vec3::Zero())};
  for (int i = 0; i < 4; ++i) {
    Part blade{Box{{0.3 * across_m, 0.04 * across_m, blade_m}}};
    blade.pose.rotate(Eigen::AngleAxisd(i * kQuarter, Vec3::UnitY()));
    blade.pose.translate(Vec3(0, 0, 0.5 * blade_m));
    blade.pose.rotate(Eigen::AngleAxisd(std::numbers::pi / 6.0, Vec3::UnitZ()));
    parts.push_back(blade);
  }
  return parts;
}

}  // namespace

std::vector<Part> parts_of(const Figure& figure) {
  switch (figure.kind) {
    case Figure::Kind::kLadder: return ladder(figure.size_m);
    case Figure::Kind::kTrap: return trap(figure.size_m);
    case Figure::Kind::kAnchor: return anchor(figure.size_m);
    case Figure::Kind::kMooring: return mooring(figure.size_m);
    case Figure::Kind::kPerson: return person(figure.size_m);
    case Figure::Kind::kBoat: return boat(figure.size_m);
    case Figure::Kind::kAircraft: return aircraft(figure.size_m);
    case Figure::Kind::kPropeller: return propeller(figure.size_m);
  }
  return {};
}

}  // namespace ensonify::solids
