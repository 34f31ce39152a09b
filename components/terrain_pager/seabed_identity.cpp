#include "components/terrain_pager/seabed_identity.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <span>
#include <string_view>
#include <system_error>
#include <variant>

#include "components/config/config_node.h"
#include "components/config/config_text.h"
#include "components/config/parse_yaml.h"
#include "components/terrain/prepared_mesh.h"
#include "components/terrain/raster_file.h"
#include "components/terrain/tiles/tile_set.h"

namespace ensonify::pager {
namespace {

std::string scenario_part(const TerrainPagerConfig& config, bool with_seed) {
  const ConfigNode world = parse_config(config.scenario_text, config.scenario_file).root;
  ConfigNode part = ConfigNode::map();
  for (const char* section : {"site", "seed", "seabed"}) {
    if (!with_seed && section == std::string_view("seed")) continue;
    if (const ConfigNode* found = world.find(section)) part.set(section, *found);
  }
  return to_canonical_yaml(part);
}

std::string guides_of(const LayeredSeabed& seabed) {
  std::string text;
  for (const layers::Layer& layer : seabed.layers) {
    const auto* guide = std::get_if<layers::Guide>(&layer.form);
    if (guide == nullptr) continue;
    if (!guide->tiles_folder.empty()) text += file_identity(guide->tiles_folder + "/" + tiles::kManifest);
    if (!guide->raster.empty()) {
      for (const std::string& file : source::files_of_raster(guide->raster)) text += file_identity(file);
    }
  }
  return text;
}

/// Files of the seabed besides guides.
std::string files_of(const TerrainPagerConfig& config) {
  const Seabed& seabed = config.terrain.seabed;
  std::string text;
  if (seabed.kind == Seabed::Kind::kTiles) text += file_identity(seabed.tiles_folder + "/" + tiles::kManifest);
  if (seabed.kind == Seabed::Kind::kRaster) {
    for (const std::string& file : source::files_of_raster(seabed.raster.path)) text += file_identity(file);
  }
  for (const SeabedMesh& mesh : seabed.meshes) {
    if (!mesh.file.empty()) text += file_identity(mesh.file) + file_identity(source::lod_path_of(mesh.file));
  }
  return text;
}

std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

/// The build ID among the notes of a segment, as hexadecimal digits, or "".
std::string build_id(std::span<const char> notes) {
  constexpr std::string_view kOwner("GNU\0", 4);  // with its terminating zero
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes.data(), sizeof note);
    notes = notes.subspan(sizeof note);
    const std::size_t name_bytes = padded(note.n_namesz), all_bytes = name_bytes + padded(note.n_descsz);
    if (all_bytes > notes.size()) return "";
    if (note.n_type == NT_GNU_BUILD_ID && std::string_view(notes.data(), note.n_namesz) == kOwner) {
      std::string digits;
      for (const char byte : notes.subspan(name_bytes, note.n_descsz))
        digits += fmt::format("{:02x}", static_cast<unsigned char>(byte));
      return digits;
    }
    notes = notes.subspan(all_bytes);
  }
  return "";
}

int add_object(dl_phdr_info* object, std::size_t, void* text) {
  const std::string path = *object->dlpi_name == '\0' ? "/proc/self/exe" : object->dlpi_name;
  std::string id;
  for (const ElfW(Phdr) & segment : std::span(object->dlpi_phdr, object->dlpi_phnum)) {
    if (segment.p_type != PT_NOTE || !id.empty()) continue;
    id = build_id({reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr), segment.p_memsz});
  }
  *static_cast<std::string*>(text) +=
      id.empty() ? file_identity(path) : fmt::format("{} {}\n", path.substr(path.rfind('/') + 1), id);
  return 0;
}

}  // namespace

std::string seabed_identity(const TerrainPagerConfig& config) {
  return scenario_part(config, true) + guides_of(config.terrain.seabed.layered) + program_identity();
}

std::string resident_identity(const TerrainPagerConfig& config) {
  if (config.scenario_text.empty()) return "";
  const source::TerrainOptions& terrain = config.terrain;
  const bool draws = terrain.seabed.kind == Seabed::Kind::kLayers || !terrain.seabed.meshes.empty();
  return config.scenario_file + "\n" + scenario_part(config, draws) + guides_of(terrain.seabed.layered) +
         files_of(config) +
         fmt::format("{} {} {}\n", terrain.raster_crs, terrain.raster_band,
                     terrain.raster_nodata ? std::to_string(*terrain.raster_nodata) : "-");
}

std::string file_identity(const std::string& path) {
  std::error_code size_error, time_error;
  const auto bytes = std::filesystem::file_size(path, size_error);
  const auto changed = std::filesystem::last_write_time(path, time_error);
  if (size_error || time_error) return path + "\n";
  return fmt::format("{} {} {}\n", path, bytes, changed.time_since_epoch().count());
}

std::string program_identity() {
  std::string text;
  ::dl_iterate_phdr(add_object, &text);
  return text;
}

}  // namespace ensonify::pager
