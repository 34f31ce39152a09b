#include <fmt/format.h>

#include <array>

#include "scenarios/world/sections.h"

namespace ensonify {
namespace {

using frames::Vec3;

void check_vertices(const ConfigReader& from, const char* key, double vertices) {
  constexpr double kMost = 500'000;
  if (vertices > kMost) from.problem(key, fmt::format("makes {:.0f} vertices; allowed: {:.0f}", vertices, kMost));
}

frames::Vec2 read_place(ConfigReader& from, const char* key) {
  std::array<double, 2> place{};
  from.required(key, place, -kFarAway_m, kFarAway_m);
  return {place[0], place[1]};
}

progressive::SheetPileWall read_wall(ConfigReader from) {
  progressive::SheetPileWall wall;
  wall.from_enu_m = read_place(from, "from_m");
  wall.to_enu_m = read_place(from, "to_m");
  from.optional("foot_depth_m", wall.foot_depth_m, -100, 11000);
  from.optional("top_height_m", wall.top_height_m, -11000, 100);
  from.optional("pile_width_m", wall.pile_width_m, 0.1, 10);
  from.optional("profile_depth_m", wall.profile_depth_m, 0.01, 10);
  from.optional("out_of_line_m", wall.out_of_line_m, 0, 1);
  from.optional("row_m", wall.row_m, 0.05, 100);
  if (!from.good()) return wall;
  if ((wall.to_enu_m - wall.from_enu_m).norm() < wall.pile_width_m)
    from.problem("to_m", "is less than a pile's width from from_m");
  else if (wall.foot_depth_m + wall.top_height_m < 0.1)
    from.problem("top_height_m", "is not above the foot; allowed: at least 0.1 m above it");
  else check_vertices(from, "row_m", progressive::vertices_of(wall));
  return wall;
}

Vec3 read_point(ConfigReader& from, const char* key) {
  std::array<double, 3> point{};
  from.required(key, point, -kFarAway_m, kFarAway_m);
  return {point[0], point[1], point[2]};
}

progressive::Bar read_bar(ConfigReader from) {
  progressive::Bar bar;
  bar.from_m = read_point(from, "from_m");
  bar.to_m = read_point(from, "to_m");
  std::array<double, 2> section{};
  from.optional("diameter_m", bar.diameter_m, 1e-3, 1e3);
  from.optional("section_m", section, 1e-3, 1e3);
  bar.section_m = {section[0], section[1]};
  for (ConfigReader entry : from.list("repeat")) {
    progressive::Repeat repeat;
    entry.required("count", repeat.count, 1, 10'000);
    repeat.step_m = read_point(entry, "step_m");
    bar.repeat.push_back(repeat);
  }
  if (from.has("diameter_m") == from.has("section_m")) from.problem("", "needs one of diameter_m, section_m");
  if (from.good() && (bar.to_m - bar.from_m).norm() < 1e-3) from.problem("to_m", "is less than 1 mm from from_m");
  return bar;
}

std::vector<progressive::Bar> read_bars(const ConfigReader& from) {
  std::vector<progressive::Bar> bars;
  for (const ConfigReader& bar : from.list("bars")) bars.push_back(read_bar(bar));
  if (bars.empty()) from.problem("bars", "is empty; at least one bar is needed");
  check_vertices(from, "bars", progressive::vertices_of(bars));
  return bars;
}

StrewnCopies read_strewn(ConfigReader from) {
  StrewnCopies strewn{.place = from.node().place};
  progressive::Strewn& where = strewn.where;
  std::array<double, 2> scale{where.least_scale, where.most_scale};
  from.required("count", strewn.count, 1, 100'000);
  where.from_enu_m = read_place(from, "from_m");
  where.to_enu_m = read_place(from, "to_m");
  from.required("width_m", where.width_m, 0, kFarAway_m);
  from.optional("scale", scale, 1e-3, 1e3);
  from.optional("size_exponent", where.size_exponent, 0.1, 10);
  strewn.on = read_classes(from, "on");
  where.least_scale = scale[0], where.most_scale = scale[1];
  if (scale[0] > scale[1]) from.problem("scale", "falls; allowed is [least, most]");
  return strewn;
}

/// Which of the ways to state a mesh are there.
std::string ways_of(const ConfigReader& from) {
  std::string ways;
  for (const char* way : {"file", "bars", "sheet_pile_wall"}) {
    if (from.has(way)) ways += (ways.empty() ? "" : ", ") + std::string(way);
  }
  return ways;
}

SeabedMesh read_mesh(const std::string& name, ConfigReader from, const Seabed& seabed) {
  SeabedMesh mesh;
  mesh.name = name;
  from.optional("sediment", mesh.sediment, 0, 255);
  if (!seabed.sediments.contains(mesh.sediment)) from.problem("sediment", "is not a class of seabed.sediments");
  const std::string way = ways_of(from);
  if (way == "sheet_pile_wall") {
    mesh.wall = read_wall(from.section("sheet_pile_wall"));
    return mesh;
  }
  if (way == "file") {
    from.required_path("file", mesh.file);
    from.optional("unit_m", mesh.unit_m, 1e-6, 1e3);
  } else if (way == "bars") {
    mesh.bars = read_bars(from);
  } else {
    from.problem("", "needs one of file, bars, sheet_pile_wall");
    return mesh;
  }
  if (const auto strewn = from.optional_section("strewn")) {
    mesh.strewn = read_strewn(*strewn);
    return mesh;
  }
  std::array<double, 3> position{};
  from.optional("position_m", position, -1e7, 1e7);  // a file may have a map's coordinates
  from.optional("heading_deg", mesh.heading_rad, -360, 360, kDegrees);
  mesh.position_enu_m = {position[0], position[1], position[2]};
  return mesh;
}

}  // namespace

void read_meshes(const ConfigReader& from, Seabed& seabed) {
  for (const auto& [name, mesh] : from.named_sections("meshes")) seabed.meshes.push_back(read_mesh(name, mesh, seabed));
}

}  // namespace ensonify
