#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include "kernels/base/random/stream.h"
#include "kernels/mesh/progressive/cut.h"

/// Surfaces to test with.
namespace ensonify::progressive {

/// A sheet of columns x rows vertices; `place` bends it.
template <class Place>
TriangleMesh sheet(int columns, int rows, Place place) {
  TriangleMesh mesh;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) mesh.vertex_m.push_back(place(i, j));
  }
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(j * columns + i); };
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      mesh.triangle.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangle.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

/// A quay wall, its vertices `step_m` apart: a level foot, a wall 8 m high whose sheet piles stand out by 0.2 m in
/// waves of 1.2 m, and a level deck; along x, wall at y = 0, water to the south. Rough by a centimetre.
inline TriangleMesh quay_wall(double length_m, double step_m = 0.2) {
  const random::Stream rough{1, "quay"};
  const auto posts = [&](double m) { return static_cast<int>(std::lround(m / step_m)); };
  const int foot = posts(6.0), wall = posts(8.0), deck = posts(4.0);
  const int along = posts(length_m) + 1;
  return sheet(along, foot + wall + deck + 1, [&](int i, int j) {
    const double x = step_m * i - 0.5 * length_m, pile = 0.1 * std::cos(2.0 * std::numbers::pi * x / 1.2);
    const double up = step_m * std::clamp(j - foot, 0, wall);
    const double y = j <= foot ? step_m * (j - foot) + pile : pile + step_m * std::max(0, j - foot - wall);
    const auto n = rough.normal_pair(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(j));
    const bool stands = j > foot && j < foot + wall;
    return Eigen::Vector3d(x, y + (stands ? 0.01 * n[0] : 0.0), up - 6.0 + (stands ? 0.0 : 0.01 * n[1]))
        .cast<float>()
        .eval();
  });
}

/// A closed one: a ball with bumps, 20 m across, its poles single vertices.
inline TriangleMesh bumpy_ball(int around = 160, int along = 80) {
  TriangleMesh mesh;
  const auto add = [&](double polar, double azimuth) {
    const double r = 10.0 + 0.5 * std::sin(7.0 * polar) * std::cos(5.0 * azimuth);
    mesh.vertex_m.emplace_back(static_cast<float>(r * std::sin(polar) * std::cos(azimuth)),
                               static_cast<float>(r * std::sin(polar) * std::sin(azimuth)),
                               static_cast<float>(r * std::cos(polar)));
  };
  add(0.0, 0.0);
  for (int j = 1; j < along; ++j) {
    for (int i = 0; i < around; ++i) add(std::numbers::pi * j / along, 2.0 * std::numbers::pi * i / around);
  }
  add(std::numbers::pi, 0.0);
  const auto at = [&](int i, int j) -> std::uint32_t {
    if (j == 0) return 0;
    if (j == along) return static_cast<std::uint32_t>(mesh.vertex_m.size() - 1);
    return static_cast<std::uint32_t>(1 + (j - 1) * around + i % around);
  };
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < around; ++i) {
      if (j > 0) mesh.triangle.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      if (j + 1 < along) mesh.triangle.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  }
  return mesh;
}

/// A fan across `heading_rad`, one degree along it and 130 degrees wide, straight down from a place.
inline View fan(const frames::Vec3& place_enu_m, double heading_rad, double tolerance_m, double max_range_m) {
  View view;
  view.tolerance_m = tolerance_m;
  lod::Frustum& f = view.frustum;
  f.apex_enu_m = place_enu_m;
  f.axis_enu = {std::sin(heading_rad), std::cos(heading_rad), 0.0};
  f.side_enu = {std::cos(heading_rad), -std::sin(heading_rad), 0.0};
  f.zero_enu = -frames::Vec3::UnitZ();
  f.high_sine = std::sin(0.5 * std::numbers::pi / 180.0);
  f.low_sine = -f.high_sine;
  f.high_angle_rad = 65.0 * std::numbers::pi / 180.0;
  f.low_angle_rad = -f.high_angle_rad;
  f.max_range_m = max_range_m;
  return view;
}

}  // namespace ensonify::progressive
