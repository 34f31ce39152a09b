#include <fmt/format.h>

#include <utility>

#include "components/config/config_reader.h"
#include "scenarios/world/mesh_keys.h"

namespace ensonify {
namespace {

void check_vertices(const ConfigReader& from, const char* key, double vertices) {
  constexpr double kMost = 500'000;
  if (vertices > kMost) from.problem(key, fmt::format("makes {:.0f} vertices; allowed: {:.0f}", vertices, kMost));
}

void put(const MeshStrewn& strewn, SeabedMesh& mesh) { mesh.strewn = strewn.strewn.copies(); }
void put(const MeshPose& pose, SeabedMesh& mesh) {
  mesh.position_enu_m = pose.position_m;
  mesh.heading_rad = pose.heading_rad;
  mesh.tilt_rad = pose.tilt_rad;
  mesh.tilt_heading_rad = pose.tilt_heading_rad;
}
void put(const MeshPlacing& placing, SeabedMesh& mesh) {
  std::visit([&](const auto& form) { put(form, mesh); }, placing);
}

void fill(const MeshOfFile& of, SeabedMesh& mesh) {
  mesh.file = of.file;
  mesh.unit_m = of.unit_m;
  mesh.up = of.up;
  put(of.placing, mesh);
}
void fill(const MeshOfBars& of, SeabedMesh& mesh) {
  mesh.bars = of.solids();
  put(of.placing, mesh);
}
void fill(const MeshOfWall& of, SeabedMesh& mesh) { mesh.wall = of.wall; }

}  // namespace

void WallKeys::check(const ConfigReader& from) const {
  if (!from.good()) return;
  if ((to_enu_m - from_enu_m).norm() < pile_width_m) from.problem("to_m", "is less than a pile's width from from_m");
  else if (foot_depth_m + top_height_m < 0.1)
    from.problem("top_height_m", "is not above the foot; allowed: at least 0.1 m above it");
  else check_vertices(from, "row_m", progressive::vertices_of(*this));
}

void BarKeys::check(const ConfigReader& from) const {
  if (from.has("diameter_m") && from.has("section_m")) from.problem("", "needs one of diameter_m, section_m");
  if (from.good() && (bar.to_m - bar.from_m).norm() < 1e-3) from.problem("to_m", "is less than 1 mm from from_m");
}

progressive::Bar BarKeys::solid() const {
  progressive::Bar solid = bar;
  if (const auto* round = std::get_if<RoundBar>(&section)) solid.diameter_m = round->diameter_m;
  if (const auto* square = std::get_if<SquareBar>(&section)) solid.section_m = square->section_m;
  solid.repeat.assign(repeat.begin(), repeat.end());
  return solid;
}

void StrewnKeys::check(const ConfigReader& from) const {
  if (scale[0] > scale[1]) from.problem("scale", "falls; allowed is [least, most]");
}

void StrewnKeys::complete(ConfigReader& from) { place = from.node().place; }

StrewnCopies StrewnKeys::copies() const {
  StrewnCopies copies{.count = count, .where = where, .on = on, .place = place};
  copies.where.least_scale = scale[0], copies.where.most_scale = scale[1];
  return copies;
}

void MeshOfBars::check(const ConfigReader& from) const {
  if (bars.empty()) from.problem("bars", "is empty; at least one bar is needed");
  check_vertices(from, "bars", progressive::vertices_of(solids()));
}

std::vector<progressive::Bar> MeshOfBars::solids() const {
  std::vector<progressive::Bar> solids;
  for (const BarKeys& bar : bars) solids.push_back(bar.solid());
  return solids;
}

void MeshKeys::check(const ConfigReader& from) const {
  int ways = 0;
  for (const char* way : {"file", "bars", "sheet_pile_wall"}) ways += int{from.has(way)};
  if (ways > 1) from.problem("", "needs one of file, bars, sheet_pile_wall");
}

SeabedMesh MeshKeys::mesh() const {
  SeabedMesh mesh;
  mesh.name = name;
  mesh.sediment = sediment;
  std::visit([&](const auto& of) { fill(of, mesh); }, form);
  return mesh;
}

}  // namespace ensonify
