#include <fmt/format.h>

#include <array>

#include "components/config/read_parameters.h"
#include "scenarios/world/sections.h"

namespace ensonify {
namespace {

void check_vertices(const ConfigReader& from, const char* key, double vertices) {
  constexpr double kMost = 500'000;
  if (vertices > kMost) from.problem(key, fmt::format("makes {:.0f} vertices; allowed: {:.0f}", vertices, kMost));
}

const Allowed kPlace = in(-kFarAway_m, kFarAway_m);

struct Wall : progressive::SheetPileWall {
  static void parameters(auto& self, auto&& visit) {
    visit("from_m", "m", must(kPlace), "east, north of one end", self.from_enu_m);
    visit("to_m", "m", must(kPlace), "east, north of the other end", self.to_enu_m);
    visit("foot_depth_m", "m", in(-100, 11000), "below chart datum: in the seabed", self.foot_depth_m);
    visit("top_height_m", "m", in(-11000, 100), "above chart datum", self.top_height_m);
    visit("pile_width_m", "m", in(0.1, 10), "from interlock to interlock, along the wall", self.pile_width_m);
    visit("profile_depth_m", "m", in(0.01, 10), "across the wall, from pan to pan", self.profile_depth_m);
    visit("out_of_line_m", "m", in(0, 1), "standard deviation of a pile's place across the wall", self.out_of_line_m);
    visit("row_m", "m", in(0.05, 100), "vertices up a pile are so far apart, or less", self.row_m);
  }
};

struct BarInFile : progressive::Bar {
  static void parameters(auto& self, auto&& visit) {
    visit("from_m", "m", must(kPlace), "middle of one end: east, north, up", self.from_m);
    visit("to_m", "m", must(kPlace), "middle of the other end: east, north, up", self.to_m);
    visit("diameter_m", "m", computed(in(1e-3, 1e3)), "of a round one", self.diameter_m);
    visit("section_m", "m", computed(in(1e-3, 1e3)), "instead: how wide it is, level and across it, and across both",
          self.section_m);
  }
};

struct RepeatInFile : progressive::Repeat {
  static void parameters(auto& self, auto&& visit) {
    visit("count", "", must(in(1, 10'000)), "number of bars in the row", self.count);
    visit("step_m", "m", must(kPlace), "from one to the next: east, north, up", self.step_m);
  }
};

struct StrewnInFile {
  int count = StrewnCopies{}.count;
  progressive::Strewn where;
  std::array<double, 2> scale{where.least_scale, where.most_scale};

  static void parameters(auto& self, auto&& visit) {
    visit("count", "", must(in(1, 100'000)), "number of copies", self.count);
    visit("from_m", "m", must(kPlace), "east, north of one end of the rectangle's middle line", self.where.from_enu_m);
    visit("to_m", "m", must(kPlace), "east, north of its other end", self.where.to_enu_m);
    visit("width_m", "m", must(in(0, kFarAway_m)), "of the rectangle, across that line", self.where.width_m);
    visit("scale", "", in(1e-3, 1e3), "sizes: [least, most]", self.scale);
    visit("size_exponent", "", in(0.1, 10), "the number above a size goes as size to the power of minus this",
          self.where.size_exponent);
  }
};

struct OfMesh {
  std::uint8_t sediment = SeabedMesh{}.sediment;

  static void parameters(auto& self, auto&& visit) {
    visit("sediment", "", in(0, 255), "class of all of it, one of seabed.sediments", self.sediment);
  }
};
struct OfFile {
  double unit_m = SeabedMesh{}.unit_m;
  SeabedMesh::Up up = SeabedMesh{}.up;

  static void parameters(auto& self, auto&& visit) {
    visit("unit_m", "m", in(1e-6, 1e3), "metres in the file's unit", self.unit_m);
    visit("up", "", one_of({{"y", SeabedMesh::Up::kY}, {"z", SeabedMesh::Up::kZ}}),
          "axis of the file that points up; with y, its z points south", self.up);
  }
};
struct MeshPose {
  frames::Vec3 position_m = frames::Vec3::Zero();
  double heading_rad = 0.0, tilt_rad = 0.0, tilt_heading_rad = 0.0;

  static void parameters(auto& self, auto&& visit) {
    // A file may have a map's coordinates.
    visit("position_m", "m", in(-1e7, 1e7), "of the file's origin, or the bars': east, north, up", self.position_m);
    visit("heading_deg", "deg", in(-360, 360), "of its y axis, clockwise from north", self.heading_rad);
    visit("tilt_deg", "deg", in(0, 180), "angle by which it leans from the upright", self.tilt_rad);
    visit("tilt_heading_deg", "deg", in(-360, 360), "direction to which it leans, clockwise from north",
          self.tilt_heading_rad);
  }
};

progressive::SheetPileWall read_wall(ConfigReader from) {
  Wall wall;
  read_parameters(from, wall);
  if (!from.good()) return wall;
  if ((wall.to_enu_m - wall.from_enu_m).norm() < wall.pile_width_m)
    from.problem("to_m", "is less than a pile's width from from_m");
  else if (wall.foot_depth_m + wall.top_height_m < 0.1)
    from.problem("top_height_m", "is not above the foot; allowed: at least 0.1 m above it");
  else check_vertices(from, "row_m", progressive::vertices_of(wall));
  return wall;
}

progressive::Bar read_bar(ConfigReader from) {
  BarInFile bar;
  read_parameters(from, bar);
  for (ConfigReader entry : from.list("repeat")) {
    RepeatInFile repeat;
    read_parameters(entry, repeat);
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
  StrewnInFile file;
  read_parameters(from, file);
  StrewnCopies strewn{
      .count = file.count, .where = file.where, .on = read_classes(from, "on"), .place = from.node().place};
  strewn.where.least_scale = file.scale[0], strewn.where.most_scale = file.scale[1];
  if (file.scale[0] > file.scale[1]) from.problem("scale", "falls; allowed is [least, most]");
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
  OfMesh of;
  read_parameters(from, of);
  mesh.sediment = of.sediment;
  if (!seabed.sediments.contains(mesh.sediment)) from.problem("sediment", "is not a class of seabed.sediments");
  const std::string way = ways_of(from);
  if (way == "sheet_pile_wall") {
    mesh.wall = read_wall(from.section("sheet_pile_wall"));
    return mesh;
  }
  if (way == "file") {
    from.required_path("file", mesh.file);
    OfFile file;
    read_parameters(from, file);
    mesh.unit_m = file.unit_m;
    mesh.up = file.up;
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
  MeshPose pose;
  read_parameters(from, pose);
  mesh.position_enu_m = pose.position_m;
  mesh.heading_rad = pose.heading_rad;
  mesh.tilt_rad = pose.tilt_rad;
  mesh.tilt_heading_rad = pose.tilt_heading_rad;
  return mesh;
}

}  // namespace

ParameterList meshes_list() {
  ParameterList bar = parameters_of<BarInFile>(), strewn = parameters_of<StrewnInFile>(),
                list = parameters_of<OfMesh>();
  bar.push_back(list_info("repeat", "a row; two of them: a grid", parameters_of<RepeatInFile>()));
  strewn.push_back(classes_info("on", "classes of the ground on which they stand; left out: all"));
  list.push_back(file_info("file", "OBJ or PLY: x east, y north, z up unless `up` says y", false));
  for (const ParameterList& part : {parameters_of<OfFile>(), parameters_of<MeshPose>()}) {
    list.insert(list.end(), part.begin(), part.end());
  }
  list.push_back(section_info("sheet_pile_wall", "a quay wall of steel", parameters_of<Wall>()));
  list.push_back(list_info("bars", "closed solids of one section from one place to another", bar));
  list.push_back(section_info("strewn", "copies of the file or the bars on the ground", strewn));
  return list;
}

void read_meshes(const ConfigReader& from, Seabed& seabed) {
  for (const auto& [name, mesh] : from.named_sections("meshes")) seabed.meshes.push_back(read_mesh(name, mesh, seabed));
}

}  // namespace ensonify
