#pragma once

#include <cstdint>
#include <string>

#include "components/terrain/terrain_source.h"
#include "kernels/mesh/progressive/hierarchy.h"
#include "scenarios/world/seabed.h"

namespace ensonify::source {

/// A mesh prepared for level of detail, what it was made from: the SHA-256 of the file, and metres in its unit.
struct LodFile {
  progressive::Hierarchy hierarchy;
  std::string source_sha256;
  double unit_m = 1.0;
};

/// Numbers are little endian and packed; the last 64 bytes are the SHA-256 of all before. Throws tiles::TileError.
void write_lod_file(const std::string& path, const LodFile& lod);

/// Throws tiles::TileError, naming the file, for one of another version, or that is damaged.
LodFile read_lod_file(const std::string& path);

struct PreparedMesh {
  LodFile lod;
  bool cached = false;  // it was read; else it has been made now, at some 60 us per vertex
};

/// The splits of a mesh file: those of `lod_path` if they were made from this very file, in this unit, and are not
/// damaged; else made anew, not written. Throws ConfigError for a mesh that cannot be read or used.
PreparedMesh prepared_mesh(const std::string& mesh_path, double unit_m, const std::string& lod_path);

/// File of the splits of a mesh file.
std::string lod_path_of(const std::string& mesh_path);

struct PlacedMesh {
  progressive::Hierarchy hierarchy;
  bool worth_preparing = false;  // a file's splits had to be made, and that took more than about a tenth of a second
};

/// A scenario's mesh where it stands. What is random in it is a function of the scenario's seed and its name. Strewn
/// copies stand on `ground`, none where it has no height. Throws as above, and where too little ground is of the
/// classes that copies stand on: when of a thousand draws per copy too few have hit it.
PlacedMesh placed_mesh(const SeabedMesh& mesh, std::uint64_t seed, const TerrainSource& ground);

}  // namespace ensonify::source
