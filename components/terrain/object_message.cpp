#include "components/terrain/object_message.h"

#include <stdexcept>

namespace ensonify {

void put_shape(const solids::Solid& solid, msg::Object& message) {
  if (const auto* sphere = std::get_if<solids::Sphere>(&solid)) {
    message.shape = "sphere";
    message.size_m = {sphere->diameter_m, 0.0, 0.0};
  } else if (const auto* box = std::get_if<solids::Box>(&solid)) {
    message.shape = "box";
    message.size_m = {box->size_m.x(), box->size_m.y(), box->size_m.z()};
  } else if (const auto* cylinder = std::get_if<solids::Cylinder>(&solid)) {
    message.shape = "cylinder";
    message.size_m = {cylinder->diameter_m, cylinder->length_m, 0.0};
  } else if (const auto* plate = std::get_if<solids::Plate>(&solid)) {
    message.shape = "plate";
    message.size_m = {plate->size_m.x(), plate->size_m.y(), 0.0};
  }
}

solids::Solid solid_of(const msg::Object& message) {
  const auto& [a, b, c] = message.size_m;
  if (message.shape == "sphere") return solids::Sphere{a};
  if (message.shape == "box") return solids::Box{{a, b, c}};
  if (message.shape == "cylinder") return solids::Cylinder{a, b};
  if (message.shape == "plate") return solids::Plate{{a, b}};
  throw std::invalid_argument("object " + message.name + ": there is no shape \"" + message.shape + "\"");
}

solids::Surface surface_of(const msg::Object& message, double sagitta_m) {
  solids::Surface surface = surface_of(solid_of(message), sagitta_m);
  const Eigen::Matrix3d turn = frames::quaternion_of(message.enu_from_object).toRotationMatrix();
  for (Eigen::Vector3f& vertex : surface.mesh.vertex_m) vertex = (turn * vertex.cast<double>()).cast<float>();
  surface.mesh.origin_enu_m = {message.position_enu_m[0], message.position_enu_m[1], message.position_enu_m[2]};
  return surface;
}

}  // namespace ensonify
