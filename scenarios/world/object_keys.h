#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenarios/world/mesh_keys.h"
#include "scenarios/world/objects.h"

/// One of `objects:` of a scenario as its file has it.
namespace ensonify {

inline Allowed object_size() { return in(1e-3, 1e3); }

// What it is.
struct SphereKeys : solids::Sphere {
  static void parameters(auto& self, auto&& visit) {
    visit("diameter_m", "m", must(object_size()), "diameter of a sphere", self.diameter_m);
  }
};
struct BoxKeys : solids::Box {
  static void parameters(auto& self, auto&& visit) {
    visit("size_m", "m", must(object_size()), "sides of a box along its x, y and z", self.size_m);
  }
};
struct CylinderKeys : solids::Cylinder {
  static void parameters(auto& self, auto&& visit) {
    visit("diameter_m", "m", must(object_size()), "diameter of a cylinder", self.diameter_m);
    visit("length_m", "m", must(object_size()), "length of a cylinder, along its y", self.length_m);
  }
};
struct PlateKeys : solids::Plate {
  static void parameters(auto& self, auto&& visit) {
    visit("size_m", "m", must(object_size()), "sides of a plate along its x and y", self.size_m);
  }
};
struct ConeKeys : solids::Cone {
  static void parameters(auto& self, auto&& visit) {
    visit("diameter_m", "m", must(object_size()), "diameter of a cone's foot", self.diameter_m);
    visit("top_diameter_m", "m", in(0, 1e3), "diameter of its top; 0: a point", self.top_diameter_m);
    visit("height_m", "m", must(object_size()), "height of a cone, along its z", self.height_m);
  }
};
struct TyreKeys : solids::Tyre {
  TyreKeys() : solids::Tyre{0.65, 0.2} {}
  static void parameters(auto& self, auto&& visit) {
    visit("diameter_m", "m", object_size(), "diameter of a tyre, over all", self.diameter_m);
    visit("width_m", "m", object_size(), "width of a tyre, along its z", self.width_m);
  }
  void check(const ConfigReader& from) const;
};
struct PipeKeys : solids::Pipe {
  static void parameters(auto& self, auto&& visit) {
    visit("diameter_m", "m", must(object_size()), "diameter of a pipe, over all", self.diameter_m);
    visit("length_m", "m", must(object_size()), "length of a pipe, along its y", self.length_m);
    visit("wall_m", "m", must(object_size()), "thickness of a pipe's wall", self.wall_m);
  }
  void check(const ConfigReader& from) const;
};
struct BottleKeys : solids::Bottle {
  BottleKeys() : solids::Bottle{0.08, 0.3} {}
  static void parameters(auto& self, auto&& visit) {
    visit("diameter_m", "m", object_size(), "diameter of a bottle's body", self.diameter_m);
    visit("length_m", "m", object_size(), "length of a bottle, along its y", self.length_m);
  }
};
struct ShellKeys : solids::Shell {
  ShellKeys() : solids::Shell{0.155, 0.7} {}
  static void parameters(auto& self, auto&& visit) {
    visit("diameter_m", "m", object_size(), "calibre of a shell", self.diameter_m);
    visit("length_m", "m", object_size(), "length of a shell, along its y", self.length_m);
  }
  void check(const ConfigReader& from) const;
};
struct WedgeKeys : solids::Wedge {
  static void parameters(auto& self, auto&& visit) {
    visit("size_m", "m", must(object_size()), "extents of a wedge along its x, y and z", self.size_m);
  }
};

struct CableKeys {
  double diameter_m = 0.0;
  std::optional<double> length_m;
  double sag_m = 0.0;
  static void parameters(auto& self, auto&& visit) {
    visit("diameter_m", "m", must(object_size()), "diameter of a cable", self.diameter_m);
    visit("length_m", "m", computed(object_size()), "distance between a cable's ends, along its y; not of a laid one",
          self.length_m);
    visit("sag_m", "m", in(0, 1e3), "depth of a cable's middle below its ends: it hangs as a catenary", self.sag_m);
  }
  operator solids::Cable() const { return {diameter_m, length_m.value_or(0.0), sag_m}; }
};
struct ChainKeys {
  double wire_m = 0.0;
  std::optional<double> length_m;
  double sag_m = 0.0;
  static void parameters(auto& self, auto&& visit) {
    visit("wire_m", "m", must(object_size()), "diameter of the wire of a chain's links", self.wire_m);
    visit("length_m", "m", computed(object_size()), "distance between a chain's ends, along its y; not of a laid one",
          self.length_m);
    visit("sag_m", "m", in(0, 1e3), "depth of a chain's middle below its ends: it hangs as a catenary", self.sag_m);
  }
  operator solids::Chain() const { return {wire_m, length_m.value_or(0.0), sag_m}; }
};

/// A shape and its word: each form has one key.
template <class Keys>
struct ShapeWord;
// clang-format off
template <> struct ShapeWord<SphereKeys> { static constexpr const char *kWord = "sphere", *kAbout = "a ball"; };
template <> struct ShapeWord<BoxKeys> { static constexpr const char *kWord = "box", *kAbout = "a cuboid"; };
template <> struct ShapeWord<CylinderKeys> { static constexpr const char *kWord = "cylinder", *kAbout = "a straight cylinder, closed at both ends, its axis along y"; };
template <> struct ShapeWord<PlateKeys> { static constexpr const char *kWord = "plate", *kAbout = "a rectangle without thickness; it lies level unless it is tilted"; };
template <> struct ShapeWord<ConeKeys> { static constexpr const char *kWord = "cone", *kAbout = "an upright cone, or one without its top"; };
template <> struct ShapeWord<TyreKeys> { static constexpr const char *kWord = "tyre", *kAbout = "a round tube in a ring that lies level"; };
template <> struct ShapeWord<PipeKeys> { static constexpr const char *kWord = "pipe", *kAbout = "a tube, open at both ends, its axis along y"; };
template <> struct ShapeWord<BottleKeys> { static constexpr const char *kWord = "bottle", *kAbout = "a bottle that lies along y, its neck to the north"; };
template <> struct ShapeWord<ShellKeys> { static constexpr const char *kWord = "shell", *kAbout = "a shell or bomb that lies along y, its nose to the north"; };
template <> struct ShapeWord<WedgeKeys> { static constexpr const char *kWord = "wedge", *kAbout = "a ramp that rises to the north"; };
template <> struct ShapeWord<CableKeys> { static constexpr const char *kWord = "cable", *kAbout = "a rope, hose or cable: it hangs between two ends, or is laid"; };
template <> struct ShapeWord<ChainKeys> { static constexpr const char *kWord = "chain", *kAbout = "links of a ship's chain: it hangs between two ends, or is laid"; };
// clang-format on
template <class Keys>
struct ObjectShape {
  static constexpr const char* kWord = ShapeWord<Keys>::kWord;
  Keys keys;
  static void parameters(auto& self, auto&& visit) { visit(kWord, ShapeWord<Keys>::kAbout, self.keys); }
  solids::Solid solid() const { return keys; }
};

/// What a figure is called, and how large it is unless the file says so.
struct FigureWord {
  const char *word, *about;
  double x_m, y_m, z_m;
};
inline constexpr std::array kFigureWords{
    FigureWord{"ladder", "two stiles along y with rungs", 0.45, 3.0, 0.06},
    FigureWord{"trap", "the frame of a lobster pot", 0.6, 0.9, 0.4},
    FigureWord{"anchor", "a stocked anchor that lies, its shank along y", 0.8, 1.2, 0.4},
    FigureWord{"mooring", "a sinker of side y, a rope and a buoy of diameter x, z from bottom to top", 0.4, 0.8, 5.0},
    FigureWord{"person", "a person on the back, the head to the north", 0.5, 1.75, 0.25},
    FigureWord{"boat", "a small boat with a cabin, its bow to the north", 2.0, 6.0, 2.0},
    FigureWord{"aircraft", "a low-winged aircraft, its nose to the north", 11.0, 8.5, 3.0},
    FigureWord{"propeller", "a hub along y with four blades", 1.0, 0.3, 1.0},
    FigureWord{"net", "a sheet of netting across x and z that bulges along y", 2.0, 0.4, 2.0},
    FigureWord{"hook", "a crane's hook that hangs, open to the east", 0.3, 0.08, 0.6},
    FigureWord{"valve", "a gate valve in a pipe along y, its handwheel above", 0.4, 0.6, 0.9},
    FigureWord{"sheet_piles", "a wall of sheet piles along x", 6.0, 0.4, 4.0},
    FigureWord{"wreck", "a ship along y that broke in two", 9.0, 30.0, 6.0},
    FigureWord{"broken_aircraft", "an aircraft that broke when it crashed, its nose to the north", 12.0, 8.5, 3.0}};

template <std::size_t kKind>
struct ObjectFigure {
  static constexpr const FigureWord& kFigure = kFigureWords[kKind];
  static constexpr const char* kWord = kFigure.word;
  struct Keys {
    frames::Vec3 size_m{kFigure.x_m, kFigure.y_m, kFigure.z_m};
    static void parameters(auto& self, auto&& visit) {
      visit("size_m", "m", object_size(), "extents along its x, y and z", self.size_m);
    }
  } keys;
  static void parameters(auto& self, auto&& visit) { visit(kWord, kFigure.about, self.keys); }
  solids::Solid solid() const { return solids::Figure{static_cast<solids::Figure::Kind>(kKind), keys.size_m}; }
};

struct MeshFileKeys {
  std::string path;
  std::optional<double> unit_m;
  bool y_is_up = false;
  double scale = 1.0;

  static void parameters(auto& self, auto&& visit) {
    visit("file", "", must(ensonify::path()), "OBJ, PLY, STL, OFF, glTF or GLB: x east, y north, z up", self.path);
    visit("unit_m", "m", computed(in(1e-6, 1e3)),
          "metres in the file's unit; left out: 1, or 0.001 where that would be larger than 100 m", self.unit_m);
    visit("up", "", one_of({{"y", true}, {"z", false}}), "axis of the file that points up; with y, its z points south",
          self.y_is_up);
    visit("scale", "", in(1e-3, 1e3), "factor on the file's sizes", self.scale);
  }
};
struct ObjectMesh {
  static constexpr const char* kWord = "mesh";
  MeshFileKeys keys;
  static void parameters(auto& self, auto&& visit) { visit("mesh", "triangles of a file", self.keys); }
  solids::Solid solid() const { return solids::Mesh{nullptr, false, keys.scale}; }
};

// Where it stands.
struct OnSeabedKeys {
  frames::Vec2 at_enu_m = frames::Vec2::Zero();
  std::optional<double> burial;

  static void parameters(auto& self, auto&& visit) {
    visit("at_m", "m", must(mesh_place()), "position of its middle: east, north", self.at_enu_m);
    visit(
        "burial", "", in(0, 1),
        "share of its volume that lies below the seabed's height at its middle; left out, and without a tilt: it lies "
        "in balance",
        self.burial);
  }
};
struct ObjectOnSeabed {
  OnSeabedKeys keys;
  static void parameters(auto& self, auto&& visit) {
    visit("on_seabed", "position on the seabed, by which its height follows", self.keys);
  }
};
struct ObjectInWater {
  frames::Vec3 position_enu_m = frames::Vec3::Zero();
  static void parameters(auto& self, auto&& visit) {
    visit("position_m", "m", must(mesh_place()), "position of its middle in the water: east, north, up",
          self.position_enu_m);
  }
};

/// Many of one kind, drawn by the scenario's seed.
struct StrewnObjectKeys {
  int count = 0;
  frames::Vec2 from_enu_m = frames::Vec2::Zero(), to_enu_m = frames::Vec2::Zero();
  double width_m = 0.0, apart_m = 0.0;
  std::array<double, 2> scale{1.0, 1.0}, heading_rad{0.0, 2.0 * std::numbers::pi};
  std::optional<std::array<double, 2>> burial;
  ConfigPlace place;

  static void parameters(auto& self, auto&& visit) {
    visit("count", "", must(in(1, 100'000)), "number of objects", self.count);
    visit("from_m", "m", must(mesh_place()), "east, north of one end of the rectangle's middle line", self.from_enu_m);
    visit("to_m", "m", must(mesh_place()), "east, north of the other end of the rectangle's middle line",
          self.to_enu_m);
    visit("width_m", "m", must(in(0, kFarAway_m)), "width of the rectangle, across its middle line", self.width_m);
    visit("apart_m", "m", in(0, 1e4), "least distance between the middles of two of them", self.apart_m);
    visit("scale", "", in(1e-3, 1e3), "factors on their sizes, [least, most], drawn evenly by their logarithm",
          self.scale);
    visit("heading_deg", "deg", in(-360, 360), "headings, [least, most], drawn evenly", self.heading_rad);
    visit("burial", "", in(0, 1), "burial, [least, most], drawn evenly; left out: they lie in balance", self.burial);
  }
  void check(const ConfigReader& from) const;
  void complete(ConfigReader& from);
};
struct ObjectStrewn {
  StrewnObjectKeys keys;
  static void parameters(auto& self, auto&& visit) {
    visit("strewn", "many of this kind on the seabed, each of its own", self.keys);
  }
};

/// A cable or chain along the seabed.
struct LaidKeys {
  std::vector<frames::Vec2> through_enu_m;
  double taut_m = 0.0, burial = 0.0, section_m = 5.0;

  static void parameters(auto& self, auto&& visit) {
    visit("through_m", "m", must(mesh_place()),
          "places that it lies through, straight from one to the next: [east, north]", self.through_enu_m);
    visit("taut_m", "m", in(0, 1e4),
          "tension over the weight in water of a metre of it: it spans hollows freely, as long as it hangs by less "
          "than their depth; 0: it is limp and follows the seabed",
          self.taut_m);
    visit("burial", "", in(0, 1), "share of its diameter that is in the seabed where it lies", self.burial);
    visit("section_m", "m", in(0.1, 1e3), "length of its sections: each is an instance of its own", self.section_m);
  }
  void check(const ConfigReader& from) const;
};
struct ObjectLaid {
  LaidKeys keys;
  static void parameters(auto& self, auto&& visit) {
    visit("laid", "the way of a cable or chain along the seabed", self.keys);
  }
};

struct ObjectKeys {
  enum class Material { kDiffuse, kSmooth };
  std::string name;
  static constexpr auto kNamedBy = &ObjectKeys::name;
  std::string class_name;
  std::variant<ObjectShape<SphereKeys>, ObjectShape<BoxKeys>, ObjectShape<CylinderKeys>, ObjectShape<PlateKeys>,
               ObjectShape<ConeKeys>, ObjectShape<TyreKeys>, ObjectShape<PipeKeys>, ObjectShape<BottleKeys>,
               ObjectShape<ShellKeys>, ObjectShape<WedgeKeys>, ObjectShape<CableKeys>, ObjectShape<ChainKeys>,
               ObjectFigure<0>, ObjectFigure<1>, ObjectFigure<2>, ObjectFigure<3>, ObjectFigure<4>, ObjectFigure<5>,
               ObjectFigure<6>, ObjectFigure<7>, ObjectFigure<8>, ObjectFigure<9>, ObjectFigure<10>, ObjectFigure<11>,
               ObjectFigure<12>, ObjectFigure<13>, ObjectMesh>
      form;
  std::variant<ObjectOnSeabed, ObjectInWater, ObjectStrewn, ObjectLaid> where;
  double heading_rad = 0.0, tilt_heading_rad = 0.0;
  std::optional<double> tilt_rad;
  Material material = Material::kDiffuse;
  std::uint8_t sediment = 0;
  bool absent = false;
  ConfigPlace written;

  static void parameters(auto& self, auto&& visit) {
    visit("class", "", any(), "class in labels; left out: its shape", self.class_name);
    visit(one_form("needs one of {}", "give one shape"), self.form);
    visit(one_form("needs one of {}", "give one or the other"), self.where);
    visit("heading_deg", "deg", in(-360, 360), "heading of its y axis, clockwise from north", self.heading_rad);
    visit("tilt_deg", "deg", in(0, 180), "angle by which it leans from the upright", self.tilt_rad);
    visit("tilt_heading_deg", "deg", in(-360, 360), "direction to which it leans, clockwise from north",
          self.tilt_heading_rad);
    visit("material", "", one_of({{"diffuse", Material::kDiffuse}, {"smooth", Material::kSmooth}}),
          "diffuse: it scatters as its sediment, with speckle; smooth: rigid, its echo follows from its shape",
          self.material);
    visit("sediment", "", in(0, 255), "class of a diffuse one, of seabed.sediments", self.sediment);
    visit("absent", "", any(), "not there; all echoes that it has no part in stay as they are, bit for bit",
          self.absent);
  }
  void complete(ConfigReader& from);
  /// One, or as many as are strewn: "mines_1" and so on. Too many to keep apart are a problem of `from`.
  std::vector<SceneObject> objects(const ConfigReader& from, std::uint64_t seed) const;

 private:
  SceneObject common() const;
};

/// In the file's order, numbered, with their classes. Problems of sediments that are not there are `from`'s.
std::vector<SceneObject> objects_of(const ConfigReader& from, const std::vector<ObjectKeys>& keys, const Seabed& seabed,
                                    std::uint64_t seed);

}  // namespace ensonify
