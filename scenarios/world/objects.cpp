#include "scenarios/world/objects.h"

#include <algorithm>
#include <cmath>

#include "components/config/config_reader.h"
#include "scenarios/world/object_keys.h"

namespace ensonify {
namespace {

void put(const ObjectOnSeabed& on, ObjectPlace& place) {
  place.position_enu_m.head<2>() = on.keys.at_enu_m;
  place.buried_share = on.keys.burial;
}
void put(const ObjectInWater& in, ObjectPlace& place) { place.position_enu_m = in.position_enu_m; }

}  // namespace

Eigen::Matrix3d ObjectPlace::enu_from_object() const {
  const frames::Vec3 hinge(-std::cos(tilt_heading_rad), std::sin(tilt_heading_rad), 0.0);
  return Eigen::AngleAxisd(tilt_rad, hinge).toRotationMatrix() *
         Eigen::AngleAxisd(-heading_rad, frames::Vec3::UnitZ()).toRotationMatrix();
}

const char* shape_of(const solids::Solid& solid) {
  constexpr const char* kWords[] = {ObjectSphere::kWord, ObjectBox::kWord, ObjectCylinder::kWord, ObjectPlate::kWord};
  return kWords[solid.index()];
}

void ObjectKeys::complete(ConfigReader& from) { written = from.node().place; }

SceneObject ObjectKeys::object() const {
  SceneObject object;
  object.name = name;
  std::visit([&](const auto& of) { object.solid = of.keys; }, form);
  std::visit([&](const auto& at) { put(at, object.place); }, where);
  object.class_name = class_name.empty() ? shape_of(object.solid) : class_name;
  object.place.heading_rad = heading_rad;
  object.place.tilt_rad = tilt_rad;
  object.place.tilt_heading_rad = tilt_heading_rad;
  object.smooth = material == Material::kSmooth;
  object.sediment = sediment;
  object.written = written;
  return object;
}

std::vector<SceneObject> objects_of(const ConfigReader& from, const std::vector<ObjectKeys>& keys,
                                    const Seabed& seabed) {
  std::vector<SceneObject> objects;
  std::vector<std::string> classes;
  for (const ObjectKeys& one : keys) {
    SceneObject& object = objects.emplace_back(one.object());
    object.instance = static_cast<std::uint32_t>(objects.size());
    auto at = std::ranges::find(classes, object.class_name);
    if (at == classes.end()) at = classes.insert(classes.end(), object.class_name);
    object.class_id = static_cast<std::uint32_t>(at - classes.begin()) + 1;
    if (!object.smooth && !seabed.sediments.contains(object.sediment))
      from.problem("objects." + object.name + ".sediment", "is not a class of seabed.sediments");
  }
  return objects;
}

}  // namespace ensonify
