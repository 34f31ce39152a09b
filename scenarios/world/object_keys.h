#pragma once

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
struct ObjectSphere {
  static constexpr const char* kWord = "sphere";
  SphereKeys keys;
  static void parameters(auto& self, auto&& visit) { visit("sphere", "a ball", self.keys); }
};
struct ObjectBox {
  static constexpr const char* kWord = "box";
  BoxKeys keys;
  static void parameters(auto& self, auto&& visit) { visit("box", "a cuboid", self.keys); }
};
struct ObjectCylinder {
  static constexpr const char* kWord = "cylinder";
  CylinderKeys keys;
  static void parameters(auto& self, auto&& visit) {
    visit("cylinder", "a straight cylinder, closed at both ends, its axis along y", self.keys);
  }
};
struct ObjectPlate {
  static constexpr const char* kWord = "plate";
  PlateKeys keys;
  static void parameters(auto& self, auto&& visit) {
    visit("plate", "a rectangle without thickness; it lies level unless it is tilted", self.keys);
  }
};

// Where it stands.
struct OnSeabedKeys {
  frames::Vec2 at_enu_m = frames::Vec2::Zero();
  double burial = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("at_m", "m", must(mesh_place()), "position of its middle: east, north", self.at_enu_m);
    visit("burial", "", in(0, 1), "share of its volume that lies below the seabed's height at its middle", self.burial);
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

struct ObjectKeys {
  enum class Material { kDiffuse, kSmooth };
  std::string name;
  static constexpr auto kNamedBy = &ObjectKeys::name;
  std::string class_name;
  std::variant<ObjectSphere, ObjectBox, ObjectCylinder, ObjectPlate> form;
  std::variant<ObjectOnSeabed, ObjectInWater> where;
  double heading_rad = 0.0, tilt_rad = 0.0, tilt_heading_rad = 0.0;
  Material material = Material::kDiffuse;
  std::uint8_t sediment = 0;
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
  }
  void complete(ConfigReader& from);
  SceneObject object() const;
};

/// In the file's order, numbered, with their classes. Problems of sediments that are not there are `from`'s.
std::vector<SceneObject> objects_of(const ConfigReader& from, const std::vector<ObjectKeys>& keys,
                                    const Seabed& seabed);

}  // namespace ensonify
