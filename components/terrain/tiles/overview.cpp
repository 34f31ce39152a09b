#include "components/terrain/tiles/overview.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <string>

#include "components/terrain/tiles/file_bytes.h"

namespace ensonify::tiles {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's numbers are stored low byte first");

std::string path_of(const TileSet& set) { return set.folder + "/" + kOverview; }

constexpr const char* kShape = "{'descr': '<f4', 'fortran_order': False, 'shape': (";
constexpr int kMostPosts = 65536;          // per side
constexpr std::size_t kHeaderBytes = 128;  // a multiple of 64, as NumPy aligns its arrays

/// Version 1.0 of the format: a magic word, the length of a Python dictionary, and this, filled up with blanks.
std::string header_of(int rows, int columns) {
  constexpr std::size_t kBefore = 10;
  std::string header("\x93NUMPY\x01\x00", 8);
  header += {static_cast<char>(kHeaderBytes - kBefore), '\0'};
  header += fmt::format("{}{}, {}), }}", kShape, rows, columns);
  header.resize(kHeaderBytes - 1, ' ');
  return header + '\n';
}

std::string checksum(const TileSet& set, const Overview& overview) {
  std::string head = fmt::format("{} {}\n", overview.rows, overview.columns);
  for (const auto& [key, facts] : set.tiles) head += facts.sha256 + "\n";
  Sha256 sum;
  sum.add(std::as_bytes(std::span(head)));
  sum.add(std::as_bytes(std::span(overview.height_m)));
  return sum.digest();
}

}  // namespace

void write_overview(TileSet& set, const Overview& overview) {
  const std::string header = header_of(overview.rows, overview.columns);
  std::vector<std::uint8_t> bytes(header.size() + overview.height_m.size() * sizeof(float));
  std::memcpy(bytes.data(), header.data(), header.size());
  std::memcpy(bytes.data() + header.size(), overview.height_m.data(), bytes.size() - header.size());
  write_file(path_of(set), bytes);
  set.overview_sha256 = checksum(set, overview);
}

Overview read_overview(const TileSet& set) {
  const auto bytes = read_file(path_of(set));
  Overview overview;
  const std::string header(bytes.begin(),
                           bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kHeaderBytes)));
  const std::size_t shape = header.find(kShape);
  if (shape != std::string::npos)
    std::sscanf(header.c_str() + shape + std::strlen(kShape), "%d, %d", &overview.rows, &overview.columns);
  const auto in_range = [](int posts) { return posts > 0 && posts <= kMostPosts; };
  const auto posts = static_cast<std::size_t>(overview.rows) * static_cast<std::size_t>(overview.columns);
  if (!in_range(overview.rows) || !in_range(overview.columns) || header != header_of(overview.rows, overview.columns) ||
      bytes.size() != kHeaderBytes + posts * sizeof(float))
    throw TileError(path_of(set) + ": is no overview as this program writes them");
  overview.height_m.resize(posts);
  std::memcpy(overview.height_m.data(), bytes.data() + kHeaderBytes, bytes.size() - kHeaderBytes);
  if (checksum(set, overview) != set.overview_sha256)
    throw TileError(path_of(set) + ": is not that of the manifest's tiles (SHA-256)");
  return overview;
}

}  // namespace ensonify::tiles
