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

/// A sheet of netting across x and z that bulges along y: sixteen meshes along its shorter side, knots of twine a tenth
/// of a mesh thick.
std::vector<Part> net(const Vec3& size_m) {
  constexpr int kMeshes = 16, kPieces = 8;
  const double mesh_m = std::min(size_m.x(), size_m.z()) / kMeshes, twine_m = std::min(0.1 * mesh_m, size_m.y());
  const Vec3 extent = size_m - Vec3::Constant(twine_m);
  const auto at_share = [&](double x, double z) {  // of both sides, -0.5 to 0.5
    const double bulge = std::cos(std::numbers::pi * x) * std::cos(std::numbers::pi * z) - 0.5;
    return Vec3(extent.x() * x, extent.y() * bulge, extent.z() * z);
  };
  std::vector<Part> parts;
  const auto twines = [&](double across_m, const auto& place) {
    const int count = std::max(1, static_cast<int>(std::lround(across_m / mesh_m)));
    for (int i = 0; i <= count; ++i) {
      for (int k = 0; k < kPieces; ++k) {
        const double share = static_cast<double>(i) / count - 0.5;
        const double from = static_cast<double>(k) / kPieces - 0.5, to = static_cast<double>(k + 1) / kPieces - 0.5;
        parts.push_back(bar(place(share, from), place(share, to), twine_m));
      }
    }
  };
  twines(size_m.x(), [&](double i, double k) { return at_share(i, k); });
  twines(size_m.z(), [&](double i, double k) { return at_share(k, i); });
  return parts;
}

/// A crane's hook that hangs: an eye above, a shank, and a bow below, open to the east.
std::vector<Part> hook(const Vec3& size_m) {
  const double bar_m = std::min(size_m.y(), 0.25 * size_m.x()), eye_m = 0.3 * size_m.z();
  const double round_x = 0.5 * (size_m.x() - bar_m), round_z = 0.3 * (size_m.z() - bar_m);
  const double top_m = 0.5 * size_m.z(), low_m = 0.5 * bar_m - top_m + round_z;  // the bow's middle
  Part eye = at(Tyre{eye_m, 0.25 * eye_m}, {0, 0, top_m - 0.5 * eye_m});
  eye.pose.rotate(Eigen::AngleAxisd(kQuarter, Vec3::UnitX()));
  std::vector<Part> parts{eye};
  constexpr int kPieces = 10;
  const auto bow = [&](int i) {  // from above by the west round to the east
    const double turn = kQuarter + 1.55 * std::numbers::pi * i / kPieces;
    return Vec3(round_x * std::cos(turn), 0.0, low_m + round_z * std::sin(turn));
  };
  parts.push_back(bar({0, 0, top_m - 0.9 * eye_m}, bow(0), bar_m));
  for (int i = 0; i < kPieces; ++i) parts.push_back(bar(bow(i), bow(i + 1), bar_m * (i < 7 ? 1.0 : 0.75)));
  return parts;
}

/// A gate valve in a pipe along y: a body between two flanges, a bonnet, a stem and a handwheel above.
std::vector<Part> valve(const Vec3& size_m) {
  const double flange_m = std::min(size_m.x(), 0.5 * size_m.z()), bottom_m = -0.5 * size_m.z();
  const double axis_m = bottom_m + 0.5 * flange_m, thick_m = 0.1 * size_m.y(), top_m = 0.5 * size_m.z();
  const double wheel_m = 0.9 * size_m.x(), tube_m = 0.12 * wheel_m;
  std::vector<Part> parts{
      at(Cylinder{0.6 * flange_m, size_m.y()}, {0, 0, axis_m}),
      at(Box{{0.5 * flange_m, 0.35 * size_m.y(), 0.5 * flange_m}}, {0, 0, axis_m + 0.45 * flange_m}),
      bar({0, 0, axis_m}, {0, 0, top_m - tube_m}, 0.15 * flange_m),
      at(Tyre{wheel_m, tube_m}, {0, 0, top_m - 0.5 * tube_m}),
      bar({-0.45 * wheel_m, 0, top_m - 0.5 * tube_m}, {0.45 * wheel_m, 0, top_m - 0.5 * tube_m}, 0.7 * tube_m)};
  for (const double end : {-1.0, 1.0})
    parts.push_back(at(Cylinder{flange_m, thick_m}, {0, end * 0.5 * (size_m.y() - thick_m), axis_m}));
  return parts;
}

/// Steel sheet piles side by side: flat pans by turns south and north, joined by webs that lean.
std::vector<Part> sheet_piles(const Vec3& size_m) {
  const double thick_m = std::min(0.06 * size_m.y(), 0.02), deep_m = size_m.y() - thick_m;
  const int count = std::max(1, static_cast<int>(std::lround(size_m.x() / (1.7 * size_m.y()))));
  const double pitch_m = size_m.x() / count, pan_m = 0.3 * pitch_m, web_m = 0.2 * pitch_m;
  std::vector<Part> parts;
  const auto sheet = [&](double from_x, double from_y, double to_x, double to_y) {
    const Vec3 along(to_x - from_x, to_y - from_y, 0.0);
    parts.push_back(turned_at(Box{{along.norm(), thick_m, size_m.z()}},
                              {0.5 * (from_x + to_x), 0.5 * (from_y + to_y), 0}, std::atan2(along.y(), along.x()),
                              Vec3::UnitZ()));
  };
  for (int i = 0; i < count; ++i) {
    double x = -0.5 * size_m.x() + pitch_m * i;
    const double south = -0.5 * deep_m, north = 0.5 * deep_m;
    sheet(x, south, x + pan_m, south), x += pan_m;
    sheet(x, south, x + web_m, north), x += web_m;
    sheet(x, north, x + pan_m, north), x += pan_m;
    sheet(x, north, x + web_m, south);
  }
  return parts;
}

/// A part moved and turned with what it belongs to.
std::vector<Part> moved(std::vector<Part> parts, const Vec3& by_m, double angle_rad, const Vec3& axis) {
  Eigen::Isometry3d pose(Eigen::Translation3d{by_m});
  pose.rotate(Eigen::AngleAxisd(angle_rad, axis));
  for (Part& part : parts) part.pose = pose * part.pose;
  return parts;
}

void append(std::vector<Part>& parts, const std::vector<Part>& more) {
  parts.insert(parts.end(), more.begin(), more.end());
}

/// A ship that broke in two: the stern half upright with its house, the bow half turned and heeled over, ribs between
/// them, a mast on the ground.
std::vector<Part> wreck(const Vec3& size_m) {
  const double beam_m = 0.6 * size_m.x(), length_m = size_m.y(), high_m = size_m.z(), hull_m = 0.55 * high_m;
  const double floor_m = -0.5 * high_m, half_m = 0.42 * length_m, thick_m = 0.02 * beam_m;
  std::vector<Part> stern{
      at(Box{{beam_m, half_m, hull_m}}, {0, 0, 0.5 * hull_m}),
      at(Box{{0.6 * beam_m, 0.35 * half_m, high_m - hull_m}}, {0, -0.2 * half_m, hull_m + 0.5 * (high_m - hull_m)})};
  std::vector<Part> parts = moved(stern, {-0.1 * size_m.x(), -0.5 * (length_m - half_m), floor_m}, 0.0, Vec3::UnitZ());
  constexpr double kHeel = 0.35;
  const double heeled_m = hull_m * std::cos(kHeel) + beam_m * std::sin(kHeel);  // its height
  std::vector<Part> bow{at(Box{{beam_m, 0.5 * half_m, hull_m}}, {0, -0.25 * half_m, 0})};
  for (const double side : {-1.0, 1.0}) {
    Part cheek = at(Wedge{{hull_m, 0.5 * half_m, 0.5 * beam_m}}, {side * 0.25 * beam_m, 0.25 * half_m, 0});
    cheek.pose.rotate(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()));
    cheek.pose.rotate(Eigen::AngleAxisd(-side * kQuarter, Vec3::UnitY()));
    bow.push_back(cheek);
  }
  bow = moved(bow, Vec3::Zero(), kHeel, Vec3::UnitY());
  append(parts,
         moved(bow, {0.1 * size_m.x(), 0.5 * (length_m - half_m), floor_m + 0.5 * heeled_m}, -0.17, Vec3::UnitZ()));
  for (int i = 0; i < 4; ++i) {
    const double y_m = length_m * (0.02 * i - 0.06);
    for (const double side : {-1.0, 1.0})
      parts.push_back(bar({side * 0.4 * beam_m, y_m, floor_m + thick_m},
                          {side * 0.5 * beam_m, y_m, floor_m + (0.6 - 0.1 * i) * hull_m}, 2.0 * thick_m));
  }
  const double mast_m = 0.04 * beam_m;
  parts.push_back(bar({0.5 * (size_m.x() - mast_m), -0.2 * length_m, floor_m + 0.5 * mast_m},
                      {0.36 * size_m.x(), 0.12 * length_m, floor_m + 0.5 * mast_m}, mast_m));
  return parts;
}

/// An aircraft after its crash: the fuselage in two, one wing where it was, the other beside it, the tail turned.
std::vector<Part> broken_aircraft(const Vec3& size_m) {
  const double span_m = 0.5 * size_m.x(), length_m = size_m.y(), body_m = std::min(0.6 * size_m.z(), 0.2 * length_m);
  const double thick_m = 0.12 * body_m, floor_m = -0.5 * size_m.z(), z_m = floor_m + 0.5 * body_m;
  const double fin_m = size_m.z() - 0.5 * body_m;
  std::vector<Part> parts{at(Shell{body_m, 0.55 * length_m}, {0, 0.225 * length_m, z_m}),
                          at(Box{{span_m, 0.18 * length_m, thick_m}}, {-0.5 * span_m, 0.12 * length_m, z_m}),
                          turned_at(Box{{0.9 * span_m, 0.18 * length_m, thick_m}},
                                    {0.54 * span_m, -0.05 * length_m, floor_m + thick_m}, 0.35, Vec3::UnitZ())};
  const std::vector<Part> tail{at(Cylinder{0.7 * body_m, 0.38 * length_m}, Vec3::Zero()),
                               at(Box{{0.6 * span_m, 0.1 * length_m, thick_m}}, {0, -0.13 * length_m, 0}),
                               at(Box{{thick_m, 0.12 * length_m, fin_m}}, {0, -0.13 * length_m, 0.5 * fin_m})};
  append(parts, moved(tail, {-0.05 * size_m.x(), -0.24 * length_m, z_m}, 0.4, Vec3::UnitZ()));
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
    case Figure::Kind::kNet: return net(figure.size_m);
    case Figure::Kind::kHook: return hook(figure.size_m);
    case Figure::Kind::kValve: return valve(figure.size_m);
    case Figure::Kind::kSheetPiles: return sheet_piles(figure.size_m);
    case Figure::Kind::kWreck: return wreck(figure.size_m);
    case Figure::Kind::kBrokenAircraft: return broken_aircraft(figure.size_m);
  }
  return {};
}

}  // namespace ensonify::solids
