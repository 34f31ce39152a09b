#include "kernels/mesh/progressive/bars.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ensonify::progressive {
namespace {

using frames::Vec2;
using frames::Vec3;

/// Corners of the section, counterclockwise as seen from its end.
std::vector<Vec2> section_of(const Bar& bar) {
  if (bar.diameter_m == 0.0) {
    const Vec2 half = 0.5 * bar.section_m;
    return {{-half.x(), -half.y()}, {half.x(), -half.y()}, {half.x(), half.y()}, {-half.x(), half.y()}};
  }
  std::vector<Vec2> corners;
  for (int i = 0; i < Bar::kSides; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / Bar::kSides;
    corners.emplace_back(0.5 * bar.diameter_m * std::cos(turn), 0.5 * bar.diameter_m * std::sin(turn));
  }
  return corners;
}

int rings_of(const Bar& bar) {
  return 1 + std::max(1, static_cast<int>(std::ceil((bar.to_m - bar.from_m).norm() / kRing_m - 1e-9)));
}

/// Where each of its copies stands from itself.
std::vector<Vec3> copies_of(const Bar& bar) {
  std::vector<Vec3> off_m = {Vec3::Zero()};
  for (const Repeat& repeat : bar.repeat) {
    std::vector<Vec3> more_m;
    for (const Vec3& at : off_m) {
      for (int i = 0; i < repeat.count; ++i) more_m.emplace_back(at + i * repeat.step_m);
    }
    off_m = std::move(more_m);
  }
  return off_m;
}

void check(const Bar& bar) {
  if (!((bar.to_m - bar.from_m).norm() > 0.0)) throw std::invalid_argument("bar: its ends are at one place");
  if (!(bar.diameter_m > 0.0 || (bar.diameter_m == 0.0 && (bar.section_m.array() > 0.0).all())))
    throw std::invalid_argument("bar: has no section; allowed is a diameter or two widths above 0 m");
  for (const Repeat& repeat : bar.repeat) {
    if (repeat.count < 1) throw std::invalid_argument("bar: is repeated less than once");
  }
}

void add(const Bar& bar, const Vec3& off_m, TriangleMesh& mesh) {
  const std::vector<Vec2> section = section_of(bar);
  const auto sides = static_cast<std::uint32_t>(section.size()), rings = static_cast<std::uint32_t>(rings_of(bar));
  const Vec3 along = (bar.to_m - bar.from_m).normalized();
  const bool upright = along.head<2>().norm() < 1e-9;
  const Vec3 level = upright ? Vec3::UnitX() : along.cross(Vec3::UnitZ()).normalized(), other = along.cross(level);
  const auto first = static_cast<std::uint32_t>(mesh.vertex_m.size());
  const auto vertex = [&](std::uint32_t ring, std::uint32_t side) { return first + ring * sides + side % sides; };
  const auto add_vertex = [&](const Vec3& place_m) { mesh.vertex_m.push_back((place_m + off_m).cast<float>()); };
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const Vec3 middle_m = bar.from_m + (bar.to_m - bar.from_m) * ring / (rings - 1);
    for (const Vec2& corner : section) add_vertex(middle_m + corner.x() * level + corner.y() * other);
  }
  add_vertex(bar.from_m);
  add_vertex(bar.to_m);
  const std::uint32_t foot = first + rings * sides, head = foot + 1;
  for (std::uint32_t side = 0; side < sides; ++side) {
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      mesh.triangle.push_back({vertex(ring, side), vertex(ring, side + 1), vertex(ring + 1, side + 1)});
      mesh.triangle.push_back({vertex(ring, side), vertex(ring + 1, side + 1), vertex(ring + 1, side)});
    }
    mesh.triangle.push_back({foot, vertex(0, side + 1), vertex(0, side)});
    mesh.triangle.push_back({head, vertex(rings - 1, side), vertex(rings - 1, side + 1)});
  }
}

}  // namespace

double vertices_of(std::span<const Bar> bars) {
  double sum = 0.0;
  for (const Bar& bar : bars) {
    double of_bar = rings_of(bar) * (bar.diameter_m > 0.0 ? Bar::kSides : 4) + 2.0;
    for (const Repeat& repeat : bar.repeat) of_bar *= repeat.count;
    sum += of_bar;
  }
  return sum;
}

TriangleMesh mesh_of(std::span<const Bar> bars) {
  TriangleMesh mesh;
  for (const Bar& bar : bars) {
    check(bar);
    for (const Vec3& off_m : copies_of(bar)) add(bar, off_m, mesh);
  }
  return mesh;
}

}  // namespace ensonify::progressive
