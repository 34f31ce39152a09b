#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/terrain/prepared_mesh.h"
#include "components/terrain/terrain_source.h"
#include "components/terrain/tiles/file_bytes.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/trace/views.h"
#include "kernels/base/frames/attitude.h"
#include "kernels/mesh/lod/cover.h"
#include "kernels/mesh/progressive/cut.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kCells = 1024;        // of a tile's side
constexpr double kMostTiles = 400;  // of posts: 2 GB

struct MeshOptions {
  std::string seabed;
  std::vector<double> at;
  double altitude_m = 50.0, heading_deg = 0.0, swath_deg = 130.0, beamwidth_deg = 1.0;
  int side_lobes = 2;
};

struct Paged {
  terrain::Tile tile;
  lod::Hierarchy hierarchy;
  lod::Cover cover;
};

/// The tiles within a horizontal distance of a place.
std::map<terrain::TileKey, Paged> tiles_within(const Opened& seabed, const frames::Vec2& place, double reach_m) {
  const terrain::TileGrid grid{.spacing_m = seabed.spacing_m, .cells = kCells, .lsb_m = seabed.lsb_m};
  const frames::Vec2 reach(reach_m, reach_m);
  const terrain::TileKey first = grid.key_at(place - reach), last = grid.key_at(place + reach);
  const double tiles = (last.east - first.east + 1.0) * (last.north - first.north + 1.0);
  if (tiles > kMostTiles) {
    throw UserError(fmt::format("the swath needs {:.0f} tiles of posts {:g} m apart; allowed: {:.0f}", tiles,
                                grid.spacing_m, kMostTiles));
  }
  std::map<terrain::TileKey, Paged> paged;
  constexpr int kPosts = kCells + 1;
  for (int east = first.east; east <= last.east; ++east) {
    for (int north = first.north; north <= last.north; ++north) {
      const terrain::TileKey key{east, north};
      terrain::Tile tile{grid.origin_of(key), grid.spacing_m, kPosts, kPosts, {}, {}};
      tile.height_m.resize(std::size_t{kPosts} * kPosts);
      tile.sediment.resize(tile.height_m.size());
      source::fill_tile(*seabed.terrain, grid, key, tile.height_m, tile.sediment);
      lod::Hierarchy hierarchy(tile);
      paged.emplace(key, Paged{std::move(tile), std::move(hierarchy), {}});
    }
  }
  return paged;
}

lod::Neighbours around(const std::map<terrain::TileKey, Paged>& paged, const terrain::TileKey& key) {
  const auto beside = [&](int east, int north) {
    const auto other = paged.find({key.east + east, key.north + north});
    return other == paged.end() ? nullptr : &other->second.cover;
  };
  return {beside(-1, 0), beside(1, 0), beside(0, -1), beside(0, 1)};
}

frames::HeadPose head_of(const MeshOptions& options, const Opened& seabed) {
  const frames::Vec2 place(options.at[0], options.at[1]);
  const double bottom_m = seabed.terrain->height_m(place);
  if (!std::isfinite(bottom_m))
    throw UserError(fmt::format("{}: has no height at {:g}, {:g}", options.seabed, place.x(), place.y()));
  return {{place.x(), place.y(), bottom_m + options.altitude_m},
          frames::enu_from_body({options.heading_deg * kDegree, 0.0, 0.0})};
}

/// What the views see of a mesh that has a name, as places and the corners of triangles: first those of the source, as
/// many as `of_the_source`, then those that stand for others. Nothing of a mesh beyond reach.
nlohmann::ordered_json shown_of(const SeabedMesh& named, const Opened& seabed, std::span<const lod::View> views) {
  const progressive::Hierarchy hierarchy = source::placed_mesh(named, seabed.seed, *seabed.terrain).hierarchy;
  const progressive::TriangleMesh& whole = hierarchy.mesh;
  Eigen::AlignedBox3d box;
  for (const auto& vertex : whole.vertex_m) box.extend(whole.origin_enu_m + vertex.cast<double>());
  const lod::Frustum& frustum = views.front().frustum;
  if (box.exteriorDistance(frustum.apex_enu_m) > frustum.max_range_m) return nullptr;
  progressive::Cut cut(hierarchy);
  cut.choose(hierarchy, progressive::views_of(views, progressive::mean_edge_m(whole)));
  std::map<std::uint32_t, std::size_t> place_of;  // by vertex
  nlohmann::ordered_json places = nlohmann::ordered_json::array(), corners = places;
  const auto place = [&](std::uint32_t vertex) {
    const auto [at, added] = place_of.try_emplace(vertex, places.size());
    if (added) {
      const frames::Vec3 enu_m = whole.origin_enu_m + whole.vertex_m[vertex].cast<double>();
      places.push_back({enu_m.x(), enu_m.y(), enu_m.z()});
    }
    return at->second;
  };
  std::size_t own_count = 0;
  for (const bool own : {true, false}) {
    for (std::size_t i = 0; i < cut.triangles().size(); ++i) {
      const auto& [a, b, c] = cut.triangles()[i];
      if ((cut.triangles()[i] == whole.triangle[cut.sources()[i]]) != own) continue;
      corners.push_back({place(a), place(b), place(c)});
      own_count += own ? 1U : 0U;
    }
  }
  return {{"name", named.name},
          {"triangles_of_all", whole.triangle.size()},
          {"of_the_source", own_count},
          {"places_enu_m", places},
          {"triangles", corners}};
}

int mesh(const MeshOptions& options) {
  const Opened seabed = open_seabed(options.seabed);
  const frames::HeadPose head = head_of(options, seabed);
  const double half_swath_rad = 0.5 * options.swath_deg * kDegree;
  const double range_m = 1.1 * options.altitude_m / std::cos(half_swath_rad);  // the seabed is not level
  const double waves = array::length_in_waves_for(options.beamwidth_deg * kDegree);
  const auto views =
      trace::views_of(trace::mills_cross_volume(waves, waves, half_swath_rad), head, range_m, {}, options.side_lobes);
  auto paged = tiles_within(seabed, head.position_enu_m.head<2>(), range_m);
  for (auto& [key, one] : paged) one.cover.choose(one.hierarchy, views);
  std::size_t shown = 0, all = 0;
  nlohmann::ordered_json blocks = nlohmann::ordered_json::array();
  for (const auto& [key, one] : paged) {
    all += 2 * std::size_t{kCells} * kCells;
    const lod::Neighbours neighbours = around(paged, key);
    for (const lod::Leaf& leaf : one.cover.leaves()) {
      const lod::Rim rim = lod::rim_of(leaf, one.cover, neighbours);
      shown += lod::patch_of(one.tile, one.hierarchy, leaf, rim, head.position_enu_m.head<2>()).triangles();
      const lod::Posts posts = one.hierarchy.posts(leaf.block);
      const frames::Vec3 low = one.tile.position_enu_m(posts.west, posts.south);
      const frames::Vec3 high = one.tile.position_enu_m(posts.east, posts.north);
      blocks.push_back({low.x(), low.y(), high.x(), high.y(), leaf.level});
    }
  }
  nlohmann::ordered_json meshes = nlohmann::ordered_json::array();
  for (const SeabedMesh& named : seabed.meshes) {
    if (auto seen = shown_of(named, seabed, views); !seen.is_null()) meshes.push_back(std::move(seen));
  }
  const frames::Vec3& place = head.position_enu_m;
  fmt::print("{}\n", nlohmann::ordered_json{{"head_enu_m", {place.x(), place.y(), place.z()}},
                                            {"spacing_m", seabed.spacing_m},
                                            {"triangles", shown},
                                            {"triangles_of_all_posts", all},
                                            {"blocks", blocks},
                                            {"meshes", meshes}}
                         .dump());
  return kExitOk;
}

struct LodOptions {
  std::string mesh, out, ping_out;
  double unit_m = 1.0;
  std::vector<double> at;
  double heading_deg = 0.0, pitch_deg = 0.0, swath_deg = 130.0, beamwidth_deg = 1.0, range_m = 100.0;
  double tolerance_m = 0.0;
};

/// A transmission's main lobe, straight paths.
progressive::View view_of(const LodOptions& options) {
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

nlohmann::ordered_json ping_of(const progressive::Hierarchy& hierarchy, const LodOptions& options) {
  const std::vector<progressive::View> views = {view_of(options)};
  progressive::Cut cut(hierarchy);
  cut.choose(hierarchy, views);
  std::size_t own = 0;
  for (std::size_t i = 0; i < cut.triangles().size(); ++i)
    own += cut.triangles()[i] == hierarchy.mesh.triangle[cut.sources()[i]] ? 1U : 0U;
  if (!options.ping_out.empty()) write_ping(options.ping_out, hierarchy.mesh, cut);
  return {{"triangles", cut.triangles().size()}, {"of_the_source", own}};
}

int lod(const LodOptions& options) {
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

Verb add_mesh(CLI::App& parent) {
  auto options = std::make_shared<MeshOptions>();
  CLI::App* app = parent.add_subcommand(
      "mesh",
      "Prints, as JSON, the blocks of the mesh that a multibeam's transmission makes of a seabed: west, south, east "
      "and "
      "north edge (m) and level (0: all posts, n: every 2^n-th) of each; and how many triangles they have. Then what "
      "it makes of the scenario's irregular meshes within its range.");
  app->add_option("seabed", options->seabed, "scenario file, or folder of a tile set")->required();
  app->add_option("--at", options->at, "EAST NORTH in m: where the head is")->expected(2)->required();
  app->add_option("--altitude", options->altitude_m, "of the head above the seabed, m")
      ->check(CLI::Range(0.5, 1000.0))
      ->capture_default_str();
  app->add_option("--heading", options->heading_deg, "degrees from north")->capture_default_str();
  app->add_option("--swath", options->swath_deg, "degrees")->check(CLI::Range(1.0, 150.0))->capture_default_str();
  app->add_option("--beam", options->beamwidth_deg, "width of a beam, degrees")
      ->check(CLI::Range(0.2, 10.0))
      ->capture_default_str();
  app->add_option("--side-lobes", options->side_lobes, "level that side lobes see")
      ->check(CLI::Range(0, lod::kCoarsest))
      ->capture_default_str();
  return {app, [options] { return mesh(*options); }};
}

Verb add_lod(CLI::App& parent) {
  auto options = std::make_shared<LodOptions>();
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
