#include "components/terrain_pager/tile_cache.h"

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <limits>
#include <thread>
#include <vector>

#include "messages/codec.h"

using namespace ensonify;
using pager::TileCache;
using terrain::TileKey;
namespace fs = std::filesystem;

namespace {

/// A folder's name that goes, with what is in it, with its owner.
struct Folder {
  fs::path path;
  explicit Folder(const std::string& name = "tiles")
      : path(fs::temp_directory_path() / ("ensonify-cache-" + name + "-" + std::to_string(::getpid()))) {
    fs::remove_all(path);
  }
  ~Folder() { fs::remove_all(path); }
};

constexpr std::uint64_t kPlenty = 1 << 30;

/// 65 x 65 posts with a hole and a negative zero, whose bits differ from zero's.
msg::Tile tile_at(const TileKey& key) {
  msg::Tile tile;
  tile.col = key.east;
  tile.row = key.north;
  tile.origin_east_m = 6.4 * key.east;
  tile.origin_north_m = 6.4 * key.north;
  tile.spacing_m = 0.1;
  tile.height_m = msg::Array<float>({65, 65});
  tile.sediment = msg::Array<std::uint8_t>({65, 65});
  for (std::size_t i = 0; i < tile.height_m.size(); ++i) {
    tile.height_m[i] = -20.0F + 0.001F * static_cast<float>(i) + static_cast<float>(key.east);
    tile.sediment[i] = static_cast<std::uint8_t>(i % 3);
  }
  tile.height_m[7] = std::numeric_limits<float>::quiet_NaN();
  tile.height_m[8] = -0.0F;
  return tile;
}

void check_same_bits(const msg::Tile& a, const msg::Tile& b) {
  CHECK(a.col == b.col);
  CHECK(a.row == b.row);
  CHECK(a.origin_east_m == b.origin_east_m);
  CHECK(a.origin_north_m == b.origin_north_m);
  CHECK(a.spacing_m == b.spacing_m);
  CHECK(a.height_m.shape() == b.height_m.shape());
  CHECK(msg::same_bytes(a.height_m.buffer(), b.height_m.buffer()));
  CHECK(a.sediment == b.sediment);
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

std::uint64_t bytes_in(const fs::path& folder) {
  std::uint64_t bytes = 0;
  for (const fs::path& file : files_in(folder)) bytes += fs::file_size(file);
  return bytes;
}

/// As if what is in the folder had been used so long ago.
void age(const fs::path& folder, std::chrono::hours by) {
  for (const fs::path& file : files_in(folder)) fs::last_write_time(file, fs::file_time_type::clock::now() - by);
}

/// Writes a file's byte anew, changed.
void damage(const fs::path& file, std::streamoff at) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(at);
  const char byte = static_cast<char>(stream.get() ^ 0x10);
  stream.seekp(at);
  stream.put(byte);
}

}  // namespace

TEST_CASE("a tile comes back from the cache as it went in, to the bit, in the next run") {
  const Folder folder;
  const TileKey key{-3, 12};
  {
    TileCache cache(folder.path, "a seabed", kPlenty);
    CHECK(cache.read(key) == nullptr);
    CHECK_FALSE(fs::exists(folder.path));  // nothing is written before there is a tile
    cache.write(tile_at(key));
    CHECK(cache.statistics().written == 1);
  }
  TileCache cache(folder.path, "a seabed", kPlenty);
  const auto kept = cache.read(key);
  REQUIRE(kept);
  check_same_bits(*kept, tile_at(key));
  CHECK(cache.statistics().read == 1);
  CHECK(cache.read({0, 0}) == nullptr);
  CHECK(cache.take_notices().empty());
}

TEST_CASE("the chart comes back to the bit too; it is not counted as a tile") {
  const Folder folder;
  msg::Chart chart;
  chart.west_m = -0.1;
  chart.spacing_m = 2.0 / 3.0;
  chart.height_m = msg::Array<float>({3, 2});
  for (std::size_t i = 0; i < chart.height_m.size(); ++i) chart.height_m[i] = -10.1F * static_cast<float>(i);
  TileCache(folder.path, "a seabed", kPlenty).write(chart);
  TileCache cache(folder.path, "a seabed", kPlenty);
  const auto kept = cache.read_chart();
  REQUIRE(kept);
  CHECK(msg::same_bytes(msg::encode_inline(msg::encode(*kept)), msg::encode_inline(msg::encode(chart))));
  CHECK(cache.statistics().read == 0);
  CHECK(TileCache(folder.path, "another", kPlenty).read_chart() == nullptr);
  damage(files_in(folder.path).at(0), 200);
  CHECK(cache.read_chart() == nullptr);
}

TEST_CASE("another seabed has tiles of its own") {
  const Folder folder;
  TileCache(folder.path, "seed: 1", kPlenty).write(tile_at({1, 1}));
  CHECK(TileCache(folder.path, "seed: 2", kPlenty).read({1, 1}) == nullptr);
  CHECK(TileCache(folder.path, "seed: 1", kPlenty).read({1, 1}));
}

TEST_CASE("a damaged file is reported, removed and made anew") {
  const Folder folder;
  TileCache(folder.path, "a seabed", kPlenty).write(tile_at({1, 1}));
  const fs::path file = files_in(folder.path).at(0);
  const auto size = static_cast<std::streamoff>(fs::file_size(file));
  SECTION("a bit of the format's name") { damage(file, 3); }
  SECTION("a bit of the checksum") { damage(file, 27); }
  SECTION("a bit of the first field") { damage(file, 90); }
  SECTION("a bit of a height") { damage(file, size / 2); }
  SECTION("a bit of the last class") { damage(file, size - 1); }
  SECTION("cut off") { fs::resize_file(file, static_cast<std::uintmax_t>(size / 2)); }
  SECTION("empty, as after a power cut") { fs::resize_file(file, 0); }
  SECTION("more behind it") { std::ofstream(file, std::ios::app) << "x"; }
  TileCache cache(folder.path, "a seabed", kPlenty);
  CHECK(cache.read({1, 1}) == nullptr);
  const auto notices = cache.take_notices();
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].event == "tile_cache_damaged");
  CHECK(notices[0].pairs == "file=" + file.string() + " why=\"is not what was written (CRC-32C)\"");
  CHECK_FALSE(fs::exists(file));
  CHECK(cache.take_notices().empty());
  cache.write(tile_at({1, 1}));
  CHECK(cache.read({1, 1}));
}

TEST_CASE("a tile in use survives loss of its file, and is made anew on the next request") {
  const Folder folder;
  TileCache cache(folder.path, "a seabed", kPlenty);
  cache.write(tile_at({1, 1}));
  const fs::path file = files_in(folder.path).at(0);
  const auto kept = cache.read({1, 1});
  REQUIRE(kept);
  SECTION("cut off") {
    fs::resize_file(file, 0);
    CHECK(cache.read({1, 1}) == nullptr);
    const auto notices = cache.take_notices();
    REQUIRE(notices.size() == 1);
    CHECK(notices[0].event == "tile_cache_damaged");
  }
  SECTION("removed") {
    fs::remove(file);
    CHECK(cache.read({1, 1}) == nullptr);
    CHECK(cache.take_notices().empty());
  }
  check_same_bits(*kept, tile_at({1, 1}));
  cache.write(tile_at({1, 1}));
  CHECK(cache.read({1, 1}));
}

TEST_CASE("a whole file in another tile's place is as good as damaged") {
  const Folder folder;
  TileCache(folder.path, "a seabed", kPlenty).write(tile_at({1, 1}));
  const fs::path first = files_in(folder.path).at(0);
  TileCache(folder.path, "a seabed", kPlenty).write(tile_at({2, 1}));
  const auto files = files_in(folder.path);
  const fs::path second = files[0] == first ? files[1] : files[0];
  fs::copy_file(first, second, fs::copy_options::overwrite_existing);
  TileCache cache(folder.path, "a seabed", kPlenty);
  CHECK(cache.read({2, 1}) == nullptr);
  CHECK(cache.read({1, 1}));
  CHECK(cache.take_notices().size() == 1);
}

TEST_CASE("the budget holds: a cache full of this run's tiles takes no more, reported once") {
  const Folder folder;
  TileCache one(folder.path, "a seabed", kPlenty);
  one.write(tile_at({0, 0}));
  const std::uint64_t tile_bytes = bytes_in(folder.path);
  TileCache cache(folder.path, "a seabed", 3 * tile_bytes + 100);  // names of other tiles may be some bytes longer
  for (int i = 0; i < 10; ++i) {
    cache.write(tile_at({i, 0}));
    CHECK(bytes_in(folder.path) <= 3 * tile_bytes + 100);
  }
  for (int i = 0; i < 10; ++i) CHECK((cache.read({i, 0}) != nullptr) == (i < 3));  // those that a start needs
  const auto notices = cache.take_notices();
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].event == "tile_cache_full");
}

TEST_CASE("earlier runs' tiles are evicted: other seabeds first, then the least used") {
  const Folder folder;
  TileCache(folder.path, "a seabed", kPlenty).write(tile_at({0, 0}));
  const std::uint64_t tile_bytes = bytes_in(folder.path);
  age(folder.path, std::chrono::hours(3));
  TileCache(folder.path, "another", kPlenty).write(tile_at({1, 0}));
  TileCache(folder.path, "a seabed", kPlenty).write(tile_at({2, 0}));
  for (const fs::path& file : files_in(folder.path)) {
    if (fs::last_write_time(file) > fs::file_time_type::clock::now() - std::chrono::hours(1))
      fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(2));
  }
  const auto there = [&](const std::string& seabed, int column) {
    // Not through read(), which would make the tile a used one.
    const Folder copy("copy");
    fs::copy(folder.path, copy.path);
    return TileCache(copy.path, seabed, kPlenty).read({column, 0}) != nullptr;
  };
  REQUIRE(there("a seabed", 0));
  REQUIRE(there("another", 1));

  TileCache cache(folder.path, "a seabed", 3 * tile_bytes + 100);
  cache.write(tile_at({3, 0}));
  CHECK_FALSE(there("another", 1));  // though (0, 0) was used an hour before it
  CHECK(there("a seabed", 0));
  cache.write(tile_at({4, 0}));
  CHECK_FALSE(there("a seabed", 0));
  CHECK(there("a seabed", 2));
  CHECK(there("a seabed", 3));
  CHECK(there("a seabed", 4));
}

TEST_CASE("a tile that was read is kept longer than one that was not") {
  const Folder folder;
  {
    TileCache before(folder.path, "a seabed", kPlenty);
    before.write(tile_at({0, 0}));
    before.write(tile_at({1, 0}));
  }
  const std::uint64_t both = bytes_in(folder.path);
  age(folder.path, std::chrono::hours(1));
  TileCache(folder.path, "a seabed", kPlenty).read({0, 0});
  TileCache cache(folder.path, "a seabed", both + 100);
  cache.write(tile_at({2, 0}));
  CHECK(cache.read({0, 0}));
  CHECK(cache.read({1, 0}) == nullptr);
  CHECK(cache.read({2, 0}));
}

TEST_CASE("a file that is no tile of a cache is neither counted nor released") {
  const Folder folder;
  fs::create_directories(folder.path);
  std::ofstream(folder.path / "survey.tile") << std::string(100'000, 'x');
  age(folder.path, std::chrono::hours(100));
  TileCache cache(folder.path, "a seabed", 50'000);
  cache.write(tile_at({0, 0}));
  CHECK(cache.read({0, 0}));
  cache.write(tile_at({1, 0}));
  cache.write(tile_at({2, 0}));  // 66 kB of tiles: over the budget
  CHECK(cache.take_notices().size() == 1);
  CHECK(fs::file_size(folder.path / "survey.tile") == 100'000);
}

TEST_CASE("a full disk is reported once, leaves no half file, and stored tiles stay") {
  const Folder folder;
  TileCache cache(folder.path, "a seabed", kPlenty);
  cache.write(tile_at({0, 0}));
  struct rlimit before {};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit small { 10'000, before.rlim_max };
  ::setrlimit(RLIMIT_FSIZE, &small);  // stands for a disk with 10 kB left
  cache.write(tile_at({1, 0}));
  cache.write(tile_at({2, 0}));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  const auto notices = cache.take_notices();
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].event == "tile_cache_failed");
  CHECK_THAT(notices[0].pairs, Catch::Contains("cannot be written: File too large"));
  CHECK(files_in(folder.path).size() == 1);
  CHECK(cache.read({0, 0}));
}

TEST_CASE("a folder that cannot be made is reported, and tiles are made without it") {
  const Folder folder;
  fs::create_directories(folder.path);
  std::ofstream(folder.path / "file") << "not a folder";
  TileCache cache(folder.path / "file" / "cache", "a seabed", kPlenty);
  CHECK(cache.read({0, 0}) == nullptr);
  cache.write(tile_at({0, 0}));
  const auto notices = cache.take_notices();
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].event == "tile_cache_failed");
  CHECK_THAT(notices[0].pairs, Catch::Contains("Not a directory"));
}

TEST_CASE("two pagers of two threads each share a folder: whoever reads, reads whole tiles") {
  const Folder folder;
  TileCache first(folder.path, "a seabed", kPlenty), second(folder.path, "a seabed", kPlenty);
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (TileCache* cache : {&first, &first, &second, &second}) {
    threads.emplace_back([cache, &wrong] {
      for (int i = 0; i < 40; ++i) {
        const TileKey key{i % 20, 0};
        const auto kept = cache->read(key);
        if (kept && !msg::same_bytes(kept->height_m.buffer(), tile_at(key).height_m.buffer())) ++wrong;
        if (!kept) cache->write(tile_at(key));
      }
    });
  }
  for (auto& thread : threads) thread.join();
  CHECK(wrong == 0);
  CHECK(first.take_notices().empty());
  CHECK(second.take_notices().empty());
  CHECK(files_in(folder.path).size() == 20);
  TileCache later(folder.path, "a seabed", kPlenty);
  for (int i = 0; i < 20; ++i) CHECK(later.read({i, 0}));
}
