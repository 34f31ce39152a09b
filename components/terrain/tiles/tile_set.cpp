#include "components/terrain/tiles/tile_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>

#include "components/config/config_reader.h"
#include "components/terrain/tiles/file_bytes.h"

namespace ensonify::tiles {
namespace {

std::string facts_text(const terrain::TileKey& key, const TileFacts& facts, const char* between) {
  return fmt::format(
      "east: {1}{0}north: {2}{0}offset_steps: {3}{0}lowest_m: {4}{0}highest_m: {5}{0}holes: {6}{0}sha256: {7}", between,
      key.east, key.north, facts.offset_steps, facts.lowest_m, facts.highest_m, facts.holes, facts.sha256);
}

std::string grid_text(const TileSet& set) {
  return fmt::format("spacing_m: {}\ncells: {}\nlsb_m: {}\n", set.grid.spacing_m, set.grid.cells, set.grid.lsb_m);
}

void read_grid(ConfigReader& from, terrain::TileGrid& grid) {
  from.required("spacing_m", grid.spacing_m, 1e-4, 1e5);
  from.required("cells", grid.cells, 1, 8192);
  from.required("lsb_m", grid.lsb_m, 1e-6, 10.0);
}

terrain::TileKey read_facts(ConfigReader& from, TileFacts& facts) {
  constexpr double kFar = 1e6;
  terrain::TileKey key;
  from.required("east", key.east, -99999, 99999);
  from.required("north", key.north, -99999, 99999);
  from.required("offset_steps", facts.offset_steps);
  from.required("lowest_m", facts.lowest_m, -kFar, kFar);
  from.required("highest_m", facts.highest_m, -kFar, kFar);
  from.required("holes", facts.holes, 0, std::numeric_limits<std::int64_t>::max());
  from.required("sha256", facts.sha256);
  return key;
}

void read_tile_format(ConfigReader& from, const std::string& wanted) {
  std::string format;
  from.required("ensonify", format);
  if (!format.empty() && format != wanted) from.problem("ensonify", "is " + format + "; this program reads " + wanted);
}

constexpr const char* kTileFormat = "tile/1";

/// One virtual raster over all tiles, in metres: the contents of seabed.vrt.
std::string vrt_text(const TileSet& set) {
  terrain::TileKey least{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max()};
  terrain::TileKey most{std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min()};
  for (const auto& [key, facts] : set.tiles) {
    least = {std::min(least.east, key.east), std::min(least.north, key.north)};
    most = {std::max(most.east, key.east), std::max(most.north, key.north)};
  }
  const int cells = set.grid.cells, side = cells + 1;
  const double s = set.grid.spacing_m;
  const frames::Vec2 west_south = set.grid.origin_of(least);
  const double north_m = set.grid.origin_of(most).y() + set.grid.side_m();
  std::string text = fmt::format(
      "<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\">\n"
      "  <SRS>+proj=tmerc +lat_0={} +lon_0={} +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m +no_defs</SRS>\n"
      "  <GeoTransform>{}, {}, 0, {}, 0, {}</GeoTransform>\n"
      "  <VRTRasterBand dataType=\"Float32\" band=\"1\">\n"
      "    <NoDataValue>nan</NoDataValue>\n    <UnitType>m</UnitType>\n",
      (most.east - least.east + 1) * cells + 1, (most.north - least.north + 1) * cells + 1, set.origin.latitude_deg,
      set.origin.longitude_deg, west_south.x() - 0.5 * s, s, north_m + 0.5 * s, -s);
  for (const auto& [key, facts] : set.tiles) {
    const std::string file = std::filesystem::path(set.path_of(key, ".png")).filename().string();
    text += fmt::format(
        "    <ComplexSource>\n      <SourceFilename relativeToVRT=\"1\">tiles/{0}</SourceFilename>\n"
        "      <SourceBand>1</SourceBand>\n"
        "      <SourceProperties RasterXSize=\"{3}\" RasterYSize=\"{3}\" DataType=\"UInt16\"/>\n"
        "      <SrcRect xOff=\"0\" yOff=\"0\" xSize=\"{3}\" ySize=\"{3}\"/>\n"
        "      <DstRect xOff=\"{1}\" yOff=\"{2}\" xSize=\"{3}\" ySize=\"{3}\"/>\n"
        "      <NODATA>0</NODATA>\n      <ScaleOffset>{4}</ScaleOffset>\n      <ScaleRatio>{5}</ScaleRatio>\n"
        "    </ComplexSource>\n",
        file, (key.east - least.east) * cells, (most.north - key.north) * cells, side,
        static_cast<double>(facts.offset_steps) * set.grid.lsb_m, set.grid.lsb_m);
  }
  return text + "  </VRTRasterBand>\n</VRTDataset>\n";
}

/// Contents of a tile's sidecar and world file; the same facts give the same bytes.
std::string sidecar_text(const TileSet& set, const terrain::TileKey& key, const TileFacts& facts) {
  return fmt::format(
             "# height in m = (offset_steps + value) * lsb_m, up from chart datum; value 0 is a hole\nensonify: {}\n",
             kTileFormat) +
         grid_text(set) + facts_text(key, facts, "\n") + "\n";
}

std::string world_file(const TileSet& set, const terrain::TileKey& key) {
  const frames::Vec2 corner = set.grid.origin_of(key);
  return fmt::format("{}\n0\n0\n{}\n{}\n{}\n", set.grid.spacing_m, -set.grid.spacing_m, corner.x(),
                     corner.y() + set.grid.side_m());
}

/// A tile as its files hold it, rows from the north.
struct Planes {
  std::int64_t offset_steps = 0;
  GreyImage<std::uint16_t> height;
  GreyImage<std::uint8_t> sediment;
};

/// Row and column of an image's value in a tile, whose rows start in the south.
std::size_t post_of(const terrain::Tile& tile, int row, int column) { return tile.post(column, tile.rows - 1 - row); }

std::string checksum(const Planes& planes) {
  const std::string head = fmt::format("{} {}\n", planes.height.side, planes.offset_steps);
  Sha256 sum;
  sum.add(std::as_bytes(std::span(head)));
  sum.add(std::as_bytes(std::span(planes.height.value)));
  sum.add(std::as_bytes(std::span(planes.sediment.value)));
  return sum.digest();
}

struct Measured {
  Planes planes;
  TileFacts facts;
};

Measured measure(const TileSet& set, const terrain::TileKey& key, const terrain::Tile& tile) {
  const int side = set.grid.cells + 1;
  if (tile.columns != side || tile.rows != side || tile.spacing_m != set.grid.spacing_m || terrain::fault_of(tile))
    throw TileError(fmt::format("tile ({}, {}): does not fit a set of {} x {} posts", key.east, key.north, side, side));
  const double lsb_m = set.grid.lsb_m;
  const auto step_of = [&](float height_m) -> std::int64_t {
    return std::llround(static_cast<double>(height_m) / lsb_m);
  };
  std::int64_t lowest = std::numeric_limits<std::int64_t>::max(), highest = std::numeric_limits<std::int64_t>::min();
  Measured m;
  for (const float height_m : tile.height_m) {
    if (!std::isfinite(height_m)) {
      ++m.facts.holes;
      continue;
    }
    lowest = std::min(lowest, step_of(height_m));
    highest = std::max(highest, step_of(height_m));
  }
  if (lowest > highest) lowest = highest = 0;
  if (highest - lowest >= kMostSteps) {
    throw TileError(fmt::format(
        "tile ({}, {}): {:.3f} m between its lowest and highest post are {} steps of {} m, and "
        "at most {} are allowed: use a larger lsb_m or smaller tiles",
        key.east, key.north, static_cast<double>(highest - lowest) * lsb_m, highest - lowest, lsb_m, kMostSteps - 1));
  }
  m.facts.offset_steps = m.planes.offset_steps = lowest - 1;
  m.facts.lowest_m = static_cast<double>(lowest) * lsb_m;
  m.facts.highest_m = static_cast<double>(highest) * lsb_m;
  m.planes.height = {side, std::vector<std::uint16_t>(tile.height_m.size())};
  m.planes.sediment = {side, std::vector<std::uint8_t>(tile.height_m.size())};
  std::size_t k = 0;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column, ++k) {
      const std::size_t post = post_of(tile, row, column);
      const float height_m = tile.height_m[post];
      if (std::isfinite(height_m))
        m.planes.height.value[k] = static_cast<std::uint16_t>(step_of(height_m) - lowest + 1);
      if (!tile.sediment.empty()) m.planes.sediment.value[k] = tile.sediment[post];
    }
  }
  m.facts.sha256 = checksum(m.planes);
  return m;
}

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

/// The posts of one side, from the south or from the west.
struct Edge {
  std::vector<float> height_m;
  std::vector<std::uint8_t> sediment;
};

Edge edge_of(const terrain::Tile& tile, const std::function<std::size_t(int)>& post) {
  Edge edge;
  for (int i = 0; i < tile.rows; ++i) {
    edge.height_m.push_back(tile.height_m[post(i)]);
    edge.sediment.push_back(tile.sediment[post(i)]);
  }
  return edge;
}

/// Posts at which two sides of one line differ; holes are equal to holes.
int differences(const Edge& a, const Edge& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.height_m.size(); ++i) {
    const bool same = a.height_m[i] == b.height_m[i] || (std::isnan(a.height_m[i]) && std::isnan(b.height_m[i]));
    if (!same || a.sediment[i] != b.sediment[i]) ++count;
  }
  return count;
}

void compare_text(const std::string& path, const std::string& wanted, std::vector<std::string>& faults) {
  const auto bytes = read_file(path);
  if (std::string(bytes.begin(), bytes.end()) != wanted)
    faults.push_back(path + ": says something else than the manifest");
}

}  // namespace

std::string TileSet::path_of(const terrain::TileKey& key, const std::string& ending) const {
  return fmt::format("{}/tiles/e{:+05d}_n{:+05d}{}", folder, key.east, key.north, ending);
}

TileFacts facts_on_disk(const TileSet& set, const terrain::TileKey& key) {
  const std::string path = set.path_of(key, ".yaml");
  if (!std::filesystem::exists(path)) return {};
  TileFacts facts;
  try {
    auto from = ConfigReader::from_file(path);
    terrain::TileGrid grid;
    read_tile_format(from, kTileFormat);
    read_grid(from, grid);
    const terrain::TileKey read = read_facts(from, facts);
    from.finish();
    const bool fits = read == key && grid.spacing_m == set.grid.spacing_m && grid.cells == set.grid.cells &&
                      grid.lsb_m == set.grid.lsb_m;
    return fits ? facts : TileFacts{};
  } catch (const ConfigError&) {
    return {};  // another version's, or not ours: it is made anew
  }
}

TileSet open_tile_set(const std::string& folder) {
  auto from = ConfigReader::from_file(folder + "/" + kManifest);
  TileSet set;
  set.folder = folder;
  read_tile_format(from, kFormat);
  auto origin = from.section("origin");
  origin.required("latitude_deg", set.origin.latitude_deg, -90, 90);
  origin.required("longitude_deg", set.origin.longitude_deg, -180, 180);
  read_grid(from, set.grid);
  from.required("made_from", set.made_from);
  from.optional("overview_sha256", set.overview_sha256);
  for (auto& tile : from.list("tiles")) {
    TileFacts facts;
    const terrain::TileKey key = read_facts(tile, facts);
    if (!set.tiles.emplace(key, facts).second)
      tile.problem("east", fmt::format("tile ({}, {}) is listed twice", key.east, key.north));
  }
  if (from.good() && set.tiles.empty()) from.problem("tiles", "the set has no tile");
  from.finish();
  return set;
}

void write_manifest(const TileSet& set) {
  std::string text = fmt::format(
      "# A seabed on disk (docs/manual/tiles.md). East and north count tiles from the world's origin.\nensonify: {}\n"
      "made_from: \"{}\"\norigin: {{ latitude_deg: {}, longitude_deg: {} }}\n",
      kFormat, set.made_from, set.origin.latitude_deg, set.origin.longitude_deg);
  text += grid_text(set);
  if (!set.overview_sha256.empty()) text += "overview_sha256: " + set.overview_sha256 + "\n";
  text += "tiles:\n";
  for (const auto& [key, facts] : set.tiles) text += "  - { " + facts_text(key, facts, ", ") + " }\n";
  write_file(set.folder + "/seabed.vrt", vrt_text(set));
  write_file(set.folder + "/" + kManifest, text);
}

TileFacts write_tile(const TileSet& set, const terrain::TileKey& key, const terrain::Tile& tile) {
  const Measured measured = measure(set, key, tile);
  std::filesystem::create_directories(set.folder + "/tiles");
  write_file(set.path_of(key, ".png"), encode_png(measured.planes.height));
  write_file(set.path_of(key, ".class.png"), encode_png(measured.planes.sediment));
  write_file(set.path_of(key, ".pgw"), world_file(set, key));
  write_file(set.path_of(key, ".yaml"), sidecar_text(set, key, measured.facts));
  return measured.facts;
}

terrain::Tile read_tile(const TileSet& set, const terrain::TileKey& key) {
  const auto facts = set.tiles.find(key);
  if (facts == set.tiles.end()) throw TileError(fmt::format("tile ({}, {}) is not in the set", key.east, key.north));
  const int side = set.grid.cells + 1;
  Planes planes{.offset_steps = facts->second.offset_steps};
  const auto decoded = [&](const std::string& path, auto& image) {
    const auto bytes = read_file(path);
    try {
      decode_png(bytes, side, image);
    } catch (const TileError& error) {
      throw TileError(path + ": " + error.what());
    }
  };
  decoded(set.path_of(key, ".png"), planes.height);
  decoded(set.path_of(key, ".class.png"), planes.sediment);
  if (checksum(planes) != facts->second.sha256)
    throw TileError(set.path_of(key, ".png") + ": heights or classes are not those of the manifest (SHA-256)");
  terrain::Tile tile{set.grid.origin_of(key), set.grid.spacing_m, side, side, {}, {}};
  tile.height_m.resize(planes.height.value.size());
  tile.sediment.resize(planes.sediment.value.size());
  std::size_t k = 0;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column, ++k) {
      const std::size_t post = post_of(tile, row, column);
      const std::uint16_t value = planes.height.value[k];
      tile.height_m[post] = value == 0
                                ? std::numeric_limits<float>::quiet_NaN()
                                : static_cast<float>(static_cast<double>(planes.offset_steps + value) * set.grid.lsb_m);
      tile.sediment[post] = planes.sediment.value[k];
    }
  }
  return tile;
}

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

std::vector<std::string> faults_of(const TileSet& set) {
  std::vector<std::string> faults;
  std::map<terrain::TileKey, Edge> east_edges, north_edges;  // of tiles whose neighbours come later
  for (const auto& [key, facts] : set.tiles) {               // western tiles first, in each column southern ones
    try {
      const terrain::Tile tile = read_tile(set, key);
      compare_text(set.path_of(key, ".yaml"), sidecar_text(set, key, facts), faults);
      compare_text(set.path_of(key, ".pgw"), world_file(set, key), faults);
      const auto last = tile.columns - 1;
      const std::string path = set.path_of(key, ".png");
      const auto compare = [&](std::map<terrain::TileKey, Edge>& edges, const terrain::TileKey& neighbour,
                               const Edge& own) {
        const auto found = edges.find(neighbour);
        if (found == edges.end()) return;
        if (const int count = differences(found->second, own); count > 0) {
          faults.push_back(fmt::format("{}: {} of the posts that it shares with tile ({}, {}) differ", path, count,
                                       neighbour.east, neighbour.north));
        }
        edges.erase(found);
      };
      compare(east_edges, {key.east - 1, key.north}, edge_of(tile, [&](int i) { return tile.post(0, i); }));
      compare(north_edges, {key.east, key.north - 1}, edge_of(tile, [&](int i) { return tile.post(i, 0); }));
      east_edges[key] = edge_of(tile, [&](int i) { return tile.post(last, i); });
      north_edges[key] = edge_of(tile, [&](int i) { return tile.post(i, last); });
    } catch (const TileError& error) {
      faults.emplace_back(error.what());
    }
  }
  try {
    if (!set.overview_sha256.empty()) read_overview(set);
  } catch (const TileError& error) {
    faults.emplace_back(error.what());
  }
  try {
    compare_text(set.folder + "/seabed.vrt", vrt_text(set), faults);
  } catch (const TileError& error) {
    faults.emplace_back(error.what());
  }
  return faults;
}

}  // namespace ensonify::tiles
