#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/terrain/prepared_mesh.h"
#include "components/terrain/tiles/file_bytes.h"
#include "kernels/base/frames/attitude.h"
#include "kernels/mesh/progressive/cut.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Options {
  std::string mesh, out, ping_out;
  double unit_m = 1.0;
  std::vector<double> at;
  double heading_deg = 0.0, pitch_deg = 0.0, swath_deg = 130.0, beamwidth_deg = 1.0, range_m = 100.0;
  double tolerance_m = 0.0;
};

/// A transmission's main lobe, straight paths.
progressive::View view_of(const Options& options) {
  const auto enu_from_head = frames::enu_from_body({options.heading_deg * kDegree, options.pitch_deg * kDegree, 0.0})
                                 .toRotationMatrix()
                                 .eval();
  progressive::View view;
  view.tolerance_m = options.tolerance_m;
  view.frustum.apex_enu_m = {options.at[0], options.at[1], options.at[2]};
  view.frustum.axis_enu = enu_from_head.col(0);  // forward, starboard, down
  view.frustum.side_enu = enu_from_head.col(1);
  view.frustum.zero_enu = enu_from_head.col(2);
  view.frustum.high_sine = std::sin(0.5 * options.beamwidth_deg * kDegree);
  view.frustum.low_sine = -view.frustum.high_sine;
  view.frustum.high_angle_rad = 0.5 * options.swath_deg * kDegree;
  view.frustum.low_angle_rad = -view.frustum.high_angle_rad;
  view.frustum.max_range_m = options.range_m;
  return view;
}

/// As OBJ, in two groups: triangles of the source, and those that stand for others.
void write_ping(const std::string& path, const progressive::TriangleMesh& mesh, const progressive::Cut& cut) {
  std::string text;
  for (const auto& vertex : mesh.vertex_m) {
    const frames::Vec3 place = mesh.origin_enu_m + vertex.cast<double>();
    text += fmt::format("v {:.4f} {:.4f} {:.4f}\n", place.x(), place.y(), place.z());
  }
  for (const bool own : {true, false}) {
    text += own ? "g source\n" : "g moved\n";
    for (std::size_t i = 0; i < cut.triangles().size(); ++i) {
      const auto& [a, b, c] = cut.triangles()[i];
      if ((cut.triangles()[i] == mesh.triangle[cut.sources()[i]]) == own)
        text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    }
  }
  tiles::write_file(path, text);
}

nlohmann::ordered_json ping_of(const progressive::Hierarchy& hierarchy, const Options& options) {
  const std::vector<progressive::View> views = {view_of(options)};
  progressive::Cut cut(hierarchy);
  cut.choose(hierarchy, views);
  std::size_t own = 0;
  for (std::size_t i = 0; i < cut.triangles().size(); ++i)
    own += cut.triangles()[i] == hierarchy.mesh.triangle[cut.sources()[i]] ? 1U : 0U;
  if (!options.ping_out.empty()) write_ping(options.ping_out, hierarchy.mesh, cut);
  return {{"triangles", cut.triangles().size()}, {"of_the_source", own}};
}

int lod(const Options& options) {
  const std::string path = options.out.empty() ? source::lod_path_of(options.mesh) : options.out;
  const source::PreparedMesh prepared = source::prepared_mesh(options.mesh, options.unit_m, path);
  if (!prepared.cached) source::write_lod_file(path, prepared.lod);
  const auto& hierarchy = prepared.lod.hierarchy;
  const frames::Vec3& origin = hierarchy.mesh.origin_enu_m;
  float farthest_m = 0.0F;
  for (const auto& split : hierarchy.splits) farthest_m = std::max(farthest_m, split.deviation_m);
  nlohmann::ordered_json reported{{"file", path},
                                  {"cached", prepared.cached},
                                  {"source_sha256", prepared.lod.source_sha256},
                                  {"origin_m", {origin.x(), origin.y(), origin.z()}},
                                  {"vertices", hierarchy.mesh.vertex_m.size()},
                                  {"triangles", hierarchy.mesh.triangle.size()},
                                  {"splits", hierarchy.splits.size()},
                                  {"coarsest_triangles", hierarchy.coarsest.size()},
                                  {"coarsest_deviation_m", std::stod(fmt::format("{:.4g}", farthest_m))}};
  if (!options.at.empty()) reported["ping"] = ping_of(hierarchy, options);
  fmt::print("{}\n", reported.dump(2));
  return kExitOk;
}

}  // namespace

Verb add_lod(CLI::App& parent) {
  auto options = std::make_shared<Options>();
  CLI::App* app = parent.add_subcommand(
      "lod",
      "Prepares a mesh (OBJ, PLY) for level of detail: vertex splits and what lies below each, in a file that is made "
      "again only when the mesh has changed. With --at it prints how many triangles a ping from there would have.");
  app->add_option("mesh", options->mesh, "OBJ or PLY; x east, y north, z up")->required()->check(CLI::ExistingFile);
  app->add_option("--out", options->out, "file (default: the mesh's name and .lod)");
  app->add_option("--unit-m", options->unit_m, "metres in the mesh's unit")
      ->check(CLI::Range(1e-6, 1e3))
      ->capture_default_str();
  app->add_option("--at", options->at, "EAST NORTH UP in m, as the mesh counts: where the head is")->expected(3);
  app->add_option("--ping-out", options->ping_out, "OBJ file for that ping's mesh")->needs("--at");
  app->add_option("--heading", options->heading_deg, "degrees from north")->capture_default_str();
  app->add_option("--pitch", options->pitch_deg, "degrees, bow up; 90 points along the heading")->capture_default_str();
  app->add_option("--swath", options->swath_deg, "degrees")->check(CLI::Range(1.0, 180.0))->capture_default_str();
  app->add_option("--beam", options->beamwidth_deg, "width of the transmission, degrees")
      ->check(CLI::Range(0.1, 90.0))
      ->capture_default_str();
  app->add_option("--range", options->range_m, "m")->check(CLI::Range(0.1, 1e5))->capture_default_str();
  app->add_option("--tolerance", options->tolerance_m, "how far the surface may be off in view, m")
      ->check(CLI::Range(0.0, 1e3))
      ->capture_default_str();
  return {app, [options] { return lod(*options); }};
}

}  // namespace ensonify::terrain_tool
