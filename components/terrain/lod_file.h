#pragma once

#include <string>

#include "kernels/mesh/progressive/hierarchy.h"

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

}  // namespace ensonify::source
