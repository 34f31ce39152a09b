#include "components/terrain_pager/seabed_identity.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <regex>

#include "components/config/config_reader.h"
#include "components/config/config_text.h"
#include "components/config/parse_yaml.h"
#include "components/terrain/tiles/tile_set.h"

using namespace ensonify;
using pager::seabed_identity;
namespace fs = std::filesystem;

namespace {

const std::string kWorld =
    "ensonify: scenario/1\n"
    "site: { name: Bay, latitude_deg: 42, longitude_deg: -70 }\n"
    "seed: 3\n"
    "seabed: { kind: layers, layers: { rock: { spectral: { rms_m: 0.3, outer_scale_m: 50 } } } }\n"
    "mission: { speed_mps: 4, runlines: [{ from_m: [-5, 0], to_m: [5, 0] }] }\n";

/// As a launch gives it to the pager.
TerrainPagerConfig config_of(const std::string& world, const Overrides& overrides = {}) {
  ConfigDocument document = parse_config(world, "world.yaml");
  REQUIRE(apply(overrides, document.root).empty());
  TerrainPagerConfig config;
  config.scenario_text = to_canonical_yaml(document.root);
  return config;
}

std::string with(const std::string& key, const std::string& value) {
  return seabed_identity(config_of(kWorld, {{key, parse_config_value(value, {"--set"})}}));
}

struct Folder {
  fs::path path = fs::temp_directory_path() / ("ensonify-identity-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

}  // namespace

TEST_CASE("another seed, place or value makes another seabed, from file or command line") {
  const std::string plain = seabed_identity(config_of(kWorld));
  CHECK(seabed_identity(config_of(kWorld)) == plain);
  CHECK(with("seed", "4") != plain);
  CHECK(with("site.latitude_deg", "42.001") != plain);
  CHECK(with("seabed.layers.rock.spectral.rms_m", "0.31") != plain);
  CHECK(with("seabed.post_spacing_m", "0.25") != plain);
  CHECK(with("seed", "3") == plain);
}

TEST_CASE("a seabed's identity ignores mission, water and comments") {
  const std::string plain = seabed_identity(config_of(kWorld));
  CHECK(with("mission.speed_mps", "2") == plain);
  CHECK(with("water.salinity_psu", "30") == plain);
  CHECK(seabed_identity(config_of("# tides\n" + kWorld)) == plain);
}

TEST_CASE("a guide's file is known by size and time") {
  const Folder folder;
  auto config = config_of(kWorld);
  const std::string none = seabed_identity(config);
  const fs::path manifest = folder.path / tiles::kManifest;
  std::ofstream(manifest) << "a set";
  layers::Guide guide;
  guide.tiles_folder = folder.path.string();
  config.terrain.seabed.layered.layers = {{.name = "macro", .form = guide}};
  const std::string first = seabed_identity(config);
  CHECK(first != none);
  CHECK(seabed_identity(config) == first);
  fs::last_write_time(manifest, fs::last_write_time(manifest) + std::chrono::seconds(1));
  const std::string later = seabed_identity(config);
  CHECK(later != first);
  const auto time = fs::last_write_time(manifest);
  std::ofstream(manifest, std::ios::app) << " more";
  fs::last_write_time(manifest, time);
  CHECK(seabed_identity(config) != later);
}

TEST_CASE("a guide's raster is known with the files that belong to it") {
  const Folder folder;
  auto config = config_of(kWorld);
  const fs::path grid = folder.path / "macro.asc", reference = folder.path / "macro.prj";
  std::ofstream(grid) << "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 5\n-20 -21\n-22 -23\n";
  std::ofstream(reference) << "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
                              "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]";
  layers::Guide guide;
  guide.raster = grid.string();
  config.terrain.seabed.layered.layers = {{.name = "macro", .form = guide}};
  const std::string first = seabed_identity(config);
  CHECK_THAT(first, Catch::Contains(grid.string()));
  fs::last_write_time(reference, fs::last_write_time(reference) + std::chrono::seconds(1));
  CHECK(seabed_identity(config) != first);
}

TEST_CASE("this program and its libraries are known by their build IDs") {
  // 8 bytes from lld, 20 from GNU ld. A build without them would fall back on the file's time.
  const std::string text = pager::program_identity();
  CHECK(std::regex_search(text, std::regex("exe ([0-9a-f]{16}|[0-9a-f]{40})\n")));
  CHECK(std::regex_search(text, std::regex("\nlibm\\.so\\.6 [0-9a-f]{40}\n")));  // its sines are in the heights
  CHECK(pager::program_identity() == text);
}
