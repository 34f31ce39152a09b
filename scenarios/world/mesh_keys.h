#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenarios/world/seabed.h"

/// One of `meshes:` of a seabed as a scenario's file has it.
namespace ensonify {

inline Allowed mesh_place() { return in(-kFarAway_m, kFarAway_m); }

struct WallKeys : progressive::SheetPileWall {
  static void parameters(auto& self, auto&& visit) {
    visit("from_m", "m", must(mesh_place()), "east, north of one end", self.from_enu_m);
    visit("to_m", "m", must(mesh_place()), "east, north of the line's other end", self.to_enu_m);
    visit("foot_depth_m", "m", in(-100, 11000), "depth of the foot below chart datum: in the seabed",
          self.foot_depth_m);
    visit("top_height_m", "m", in(-11000, 100), "height of the top above chart datum", self.top_height_m);
    visit("pile_width_m", "m", in(0.1, 10), "width of a pile from interlock to interlock, along the wall",
          self.pile_width_m);
    visit("profile_depth_m", "m", in(0.01, 10), "across the wall, from pan to pan", self.profile_depth_m);
    visit("out_of_line_m", "m", in(0, 1), "standard deviation of a pile's place across the wall", self.out_of_line_m);
    visit("row_m", "m", in(0.05, 100), "vertices up a pile are so far apart, or less", self.row_m);
  }
  void check(const ConfigReader& from) const;
};

struct RepeatKeys : progressive::Repeat {
  static void parameters(auto& self, auto&& visit) {
    visit("count", "", must(in(1, 10'000)), "number of bars in the row", self.count);
    visit("step_m", "m", must(mesh_place()), "step from one bar to the next: east, north, up", self.step_m);
  }
};
struct RoundBar {
  double diameter_m = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("diameter_m", "m", must(in(1e-3, 1e3)), "diameter of a round bar", self.diameter_m);
  }
};
struct SquareBar {
  frames::Vec2 section_m = frames::Vec2::Zero();

  static void parameters(auto& self, auto&& visit) {
    visit("section_m", "m", must(in(1e-3, 1e3)),
          "section of an angular bar instead of a diameter: width, level and across it, and across both",
          self.section_m);
  }
};
struct BarKeys {
  progressive::Bar bar;  // its ends
  std::variant<RoundBar, SquareBar> section;
  std::vector<RepeatKeys> repeat;

  static void parameters(auto& self, auto&& visit) {
    visit("from_m", "m", must(mesh_place()), "middle of one end: east, north, up", self.bar.from_m);
    visit("to_m", "m", must(mesh_place()), "middle of the other end: east, north, up", self.bar.to_m);
    visit(one_form("needs one of diameter_m, section_m", ""), self.section);
    visit("repeat", "a row; two of them: a grid", self.repeat);
  }
  void check(const ConfigReader& from) const;
  progressive::Bar solid() const;
};

struct StrewnKeys {
  int count = StrewnCopies{}.count;
  progressive::Strewn where;
  std::array<double, 2> scale{where.least_scale, where.most_scale};
  std::vector<std::uint8_t> on;
  ConfigPlace place;

  static void parameters(auto& self, auto&& visit) {
    visit("count", "", must(in(1, 100'000)), "number of copies", self.count);
    visit("from_m", "m", must(mesh_place()), "east, north of one end of the rectangle's middle line",
          self.where.from_enu_m);
    visit("to_m", "m", must(mesh_place()), "east, north of the other end of the rectangle's middle line",
          self.where.to_enu_m);
    visit("width_m", "m", must(in(0, kFarAway_m)), "width of the rectangle, across its middle line",
          self.where.width_m);
    visit("scale", "", in(1e-3, 1e3), "sizes: [least, most]", self.scale);
    visit("size_exponent", "", in(0.1, 10), "the number above a size goes as size to the power of minus this",
          self.where.size_exponent);
    visit("on", "", computed(called("a class", in(0, 255))), "classes of the ground on which they stand; left out: all",
          self.on);
  }
  void check(const ConfigReader& from) const;
  void complete(ConfigReader& from);
  StrewnCopies copies() const;
};

// Where it stands: many, or one.
struct MeshStrewn {
  StrewnKeys strewn;

  static void parameters(auto& self, auto&& visit) {
    visit("strewn", "copies of the file or the bars on the ground", self.strewn);
  }
};
struct MeshPose {
  frames::Vec3 position_m = frames::Vec3::Zero();
  double heading_rad = 0.0, tilt_rad = 0.0, tilt_heading_rad = 0.0;

  static void parameters(auto& self, auto&& visit) {
    // A file may have a map's coordinates.
    visit("position_m", "m", in(-1e7, 1e7), "position of the file's origin, or the bars': east, north, up",
          self.position_m);
    visit("heading_deg", "deg", in(-360, 360), "heading of the file's y axis, clockwise from north", self.heading_rad);
    visit("tilt_deg", "deg", in(0, 180), "angle by which it leans from the upright", self.tilt_rad);
    visit("tilt_heading_deg", "deg", in(-360, 360), "direction to which it leans, clockwise from north",
          self.tilt_heading_rad);
  }
};
using MeshPlacing = std::variant<MeshStrewn, MeshPose>;

// What it is.
struct MeshOfFile {
  std::string file;
  double unit_m = SeabedMesh{}.unit_m;
  SeabedMesh::Up up = SeabedMesh{}.up;
  MeshPlacing placing = MeshPose{};

  static void parameters(auto& self, auto&& visit) {
    visit("file", "", must(path()), "OBJ, PLY, STL, OFF, glTF or GLB: x east, y north, z up unless `up` says y",
          self.file);
    visit("unit_m", "m", in(1e-6, 1e3), "metres in the file's unit", self.unit_m);
    visit("up", "", one_of({{"y", SeabedMesh::Up::kY}, {"z", SeabedMesh::Up::kZ}}),
          "axis of the file that points up; with y, its z points south", self.up);
    visit(one_form(), self.placing);
  }
};
struct MeshOfBars {
  std::vector<BarKeys> bars;
  MeshPlacing placing = MeshPose{};

  static void parameters(auto& self, auto&& visit) {
    visit("bars", "closed solids of one section from one place to another", self.bars);
    visit(one_form(), self.placing);
  }
  void check(const ConfigReader& from) const;
  std::vector<progressive::Bar> solids() const;
};
struct MeshOfWall {
  WallKeys wall;

  static void parameters(auto& self, auto&& visit) { visit("sheet_pile_wall", "a quay wall of steel", self.wall); }
};

struct MeshKeys {
  std::string name;
  static constexpr auto kNamedBy = &MeshKeys::name;
  std::uint8_t sediment = SeabedMesh{}.sediment;
  std::variant<MeshOfFile, MeshOfBars, MeshOfWall> form;

  static void parameters(auto& self, auto&& visit) {
    visit("sediment", "", in(0, 255), "class of all of it, one of seabed.sediments", self.sediment);
    visit(one_form("needs one of {}", ""), self.form);
  }
  void check(const ConfigReader& from) const;
  SeabedMesh mesh() const;
};

}  // namespace ensonify
