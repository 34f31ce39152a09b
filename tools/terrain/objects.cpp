#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "components/errors/exit_error.h"
#include "components/terrain/placed_object.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

nlohmann::ordered_json json_of(const source::PlacedObject& placed) {
  const msg::Object& object = placed.message;
  nlohmann::ordered_json json = {{"name", object.name},
                                 {"class", object.class_name},
                                 {"class_id", object.class_id},
                                 {"instance", object.instance},
                                 {"shape", object.shape},
                                 {"smooth", object.smooth},
                                 {"absent", object.absent},
                                 {"position_enu_m", object.position_enu_m},
                                 {"enu_from_object", object.enu_from_object}};
  const progressive::TriangleMesh& mesh = placed.surface.mesh;
  auto& places = json["places_enu_m"] = nlohmann::ordered_json::array();
  for (const Eigen::Vector3f& vertex : mesh.vertex_m) {
    const frames::Vec3 at = mesh.origin_enu_m + vertex.cast<double>();
    places.push_back({at.x(), at.y(), at.z()});
  }
  json["triangles"] = mesh.triangle;
  return json;
}

int print_objects(const std::string& scenario) {
  const Opened opened = open_seabed(scenario);
  auto all = nlohmann::ordered_json::array();
  source::ObjectMeshes files;
  for (const SceneObject& object : opened.objects)
    all.push_back(json_of(placed_object(object, files, *opened.terrain)));
  fmt::print("{}\n", all.dump());
  return kExitOk;
}

}  // namespace

Verb add_objects(CLI::App& parent) {
  auto* app =
      parent.add_subcommand("objects",
                            "Prints a scenario's objects where they stand, as JSON: name, class, instance, shape, "
                            "position (m: east, north, up), rotation [w, x, y, z], and their surface as triangles.");
  auto scenario = std::make_shared<std::string>();
  app->add_option("scenario", *scenario, "scenario file")->required();
  return {app, [scenario] { return print_objects(*scenario); }};
}

}  // namespace ensonify::terrain_tool
