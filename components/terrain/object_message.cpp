#include "components/terrain/object_message.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "kernels/mesh/solids/words.h"

namespace ensonify {

void put_shape(const solids::Solid& solid, msg::Object& message) {
  message.shape = solids::word_of(solid);
  message.size_m = solids::sizes_of(solid);
}

solids::Solid solid_of(const msg::Object& message, const solids::Mesh* mesh) {
  if (message.mesh >= 0) {
    if (mesh == nullptr) throw std::invalid_argument("object " + message.name + ": its mesh has not come");
    return solids::Mesh{mesh->triangles, mesh->closed, message.size_m[0]};
  }
  if (auto solid = solids::solid_of(message.shape, message.size_m)) return *std::move(solid);
  throw std::invalid_argument("object " + message.name + ": there is no shape \"" + message.shape + "\"");
}

msg::ObjectMesh object_mesh_message(std::int64_t number, const solids::Mesh& mesh) {
  const progressive::TriangleMesh& triangles = *mesh.triangles;
  msg::ObjectMesh message{number, mesh.closed, msg::Array<float>({triangles.vertex_m.size(), 3}),
                          msg::Array<std::uint32_t>({triangles.triangle.size(), 3})};
  auto vertex = message.vertex_m.flat().begin();
  for (const Eigen::Vector3f& place : triangles.vertex_m) vertex = std::copy_n(place.data(), 3, vertex);
  auto corner = message.triangle.flat().begin();
  for (const auto& corners : triangles.triangle) corner = std::ranges::copy(corners, corner).out;
  return message;
}

solids::Mesh mesh_of(const msg::ObjectMesh& message) {
  auto triangles = std::make_shared<progressive::TriangleMesh>();
  const auto vertex = message.vertex_m.flat();
  for (std::size_t v = 0; v + 2 < vertex.size(); v += 3)
    triangles->vertex_m.emplace_back(vertex[v], vertex[v + 1], vertex[v + 2]);
  const auto corner = message.triangle.flat();
  for (std::size_t t = 0; t + 2 < corner.size(); t += 3)
    triangles->triangle.push_back({corner[t], corner[t + 1], corner[t + 2]});
  return {std::move(triangles), message.closed, 1.0};
}

solids::Surface surface_of(const msg::Object& message, const solids::Solid& solid, double sagitta_m) {
  solids::Surface surface = solids::surface_of(solid, sagitta_m);
  const Eigen::Matrix3d turn = frames::quaternion_of(message.enu_from_object).toRotationMatrix();
  for (Eigen::Vector3f& vertex : surface.mesh.vertex_m) vertex = (turn * vertex.cast<double>()).cast<float>();
  surface.mesh.origin_enu_m = {message.position_enu_m[0], message.position_enu_m[1], message.position_enu_m[2]};
  return surface;
}

}  // namespace ensonify
