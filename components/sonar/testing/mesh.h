#pragma once

#include <cstdint>
#include <utility>

#include "components/terrain/mesh_message.h"
#include "kernels/mesh/progressive/hierarchy.h"

namespace ensonify {

/// For tests of what receives meshes: a square about the origin, `side_m` wide, level at a height, as 2 x 8 x 8
/// triangles.
inline msg::Mesh table_of(double side_m, double height_m) {
  constexpr std::uint32_t kCells = 8, kPosts = kCells + 1;
  progressive::TriangleMesh table;
  table.origin_enu_m = {0.0, 0.0, height_m};
  for (std::uint32_t row = 0; row < kPosts; ++row) {
    for (std::uint32_t column = 0; column < kPosts; ++column) {
      const frames::Vec3 place(side_m * (column / double{kCells} - 0.5), side_m * (row / double{kCells} - 0.5), 0.0);
      table.vertex_m.push_back(place.cast<float>());
    }
  }
  for (std::uint32_t row = 0; row < kCells; ++row) {
    for (std::uint32_t column = 0; column < kCells; ++column) {
      const std::uint32_t v = row * kPosts + column;
      table.triangle.push_back({v, v + 1, v + kPosts + 1});
      table.triangle.push_back({v, v + kPosts + 1, v + kPosts});
    }
  }
  const auto collapses = progressive::collapses_of(table);
  return mesh_message(progressive::hierarchy_of(std::move(table), collapses));
}

}  // namespace ensonify
