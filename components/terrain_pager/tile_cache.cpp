#include "components/terrain_pager/tile_cache.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "components/terrain/tiles/file_bytes.h"
#include "messages/codec.h"

namespace ensonify::pager {
namespace {

namespace fs = std::filesystem;
using terrain::TileKey;

constexpr const char* kFormat = "ensonify cached tile/2";
constexpr std::size_t kDigits = 64;  // of a SHA-256

std::string sha256_of(std::span<const std::byte> bytes) {
  tiles::Sha256 sum;
  sum.add(bytes);
  return sum.digest();
}

/// A name that no other writer has: two pagers may write the same tile at the same time.
fs::path part_of(const fs::path& path) {
  static std::atomic<int> parts = 0;
  return fmt::format("{}.{}-{}", path.string(), ::getpid(), ++parts);
}

/// `<SHA-256 of the seabed>_e+0003_n-0001.tile` or `..._chart.tile`, or that with a writer's numbers behind it.
bool is_name_of_tile(const std::string& name) {
  return name.size() > kDigits && name.find_first_not_of("0123456789abcdef") == kDigits && name[kDigits] == '_' &&
         name.find(".tile") != std::string::npos;
}

/// A file's bytes, read whole. They are not mapped: where a mapped file is cut off while its tile is in use, whoever
/// examines it next is ended by SIGBUS.
msg::Buffer bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream) throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno));
  const auto size = static_cast<std::size_t>(std::max<std::streamoff>(0, stream.tellg()));
  const std::shared_ptr<std::byte[]> bytes(new std::byte[size]);  // a vector would write zeros first
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.get()), static_cast<std::streamsize>(size));
  if (!stream) throw std::runtime_error("cannot be read to its end");
  return {bytes, bytes.get(), size};
}

/// What goes behind the first line so that the heights stand where floats may: they need not be copied when they are
/// read.
std::string padding(std::size_t line, const msg::Buffer& payload) {
  const msg::Value message = msg::decode_inline(payload);
  const std::byte* heights = message.find("height_m")->as<msg::RawArray>()->bytes.data;
  const std::size_t at = line + 1 + static_cast<std::size_t>(heights - payload.data);
  return std::string((alignof(float) - at % alignof(float)) % alignof(float), ' ');
}

/// The first line of a file, but for blanks at its end. Its checksum is of the file's name and of all that follows the
/// line.
std::string line_of(const std::string& name, std::span<const std::byte> payload) {
  return fmt::format("{} {:08x}", kFormat, tiles::crc32c(payload, tiles::crc32c(std::as_bytes(std::span(name)))));
}

/// What follows the first line.
msg::Buffer checked(const std::string& name, const msg::Buffer& file) {
  const std::size_t head = std::min(file.text().find('\n'), file.size - 1) + 1;
  const msg::Buffer payload{file.owner, file.data + head, file.size - head};
  const std::string line = line_of(name, payload.bytes());
  const std::string_view first = file.text().substr(0, head);
  if (!first.starts_with(line) || first.find_first_not_of(' ', line.size()) != head - 1 || first.back() != '\n')
    throw std::runtime_error("is not what was written (CRC-32C)");
  return payload;
}

}  // namespace

struct TileCache::Kept {
  fs::path path;
  bool own = false;  // of this seabed
  fs::file_time_type used;
  std::uint64_t bytes = 0;
};

// A second before now: the clock of files ticks in milliseconds.
TileCache::TileCache(fs::path folder, const std::string& seabed, std::uint64_t most_bytes)
    : folder_(std::move(folder)),
      seabed_(sha256_of(std::as_bytes(std::span(seabed)))),
      most_bytes_(most_bytes),
      begin_(fs::file_time_type::clock::now() - std::chrono::seconds(1)) {}

std::string TileCache::name_of(const TileKey& key) const {
  return fmt::format("{}_e{:+05d}_n{:+05d}.tile", seabed_, key.east, key.north);
}

std::string TileCache::name_of_chart() const { return seabed_ + "_chart.tile"; }

template <class Message>
std::shared_ptr<const Message> TileCache::read_named(const std::string& name) {
  const fs::path path = folder_ / name;
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return nullptr;
  try {
    auto message = std::make_shared<Message>();
    msg::from_value(msg::decode_inline(checked(name, bytes_of(path))), *message, "");
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
    const std::scoped_lock lock(mutex_);
    used_.insert(name);
    statistics_.read += std::is_same_v<Message, msg::Tile> ? 1 : 0;
    return message;
  } catch (const std::exception& error) {
    if (!fs::exists(path, ignored)) return nullptr;  // another process has just released it
    fs::remove(path, ignored);
    const std::scoped_lock lock(mutex_);
    notices_.push_back({"tile_cache_damaged", fmt::format("file={} why=\"{}\"", path.string(), error.what())});
    return nullptr;
  }
}

TileCache::TilePtr TileCache::read(const TileKey& key) { return read_named<msg::Tile>(name_of(key)); }

std::shared_ptr<const msg::Chart> TileCache::read_chart() { return read_named<msg::Chart>(name_of_chart()); }

std::vector<TileCache::Kept> TileCache::kept() const {
  std::vector<Kept> all;
  std::error_code gone;  // a file may go, or be no file, while we check
  for (fs::directory_iterator at(folder_, gone), end; !gone && at != end; at.increment(gone)) {
    const std::string name = at->path().filename().string();
    std::error_code error;
    Kept file{at->path(), name.starts_with(seabed_), at->last_write_time(error), at->file_size(error)};
    if (!error && is_name_of_tile(name)) all.push_back(std::move(file));
  }
  return all;
}

/// Releases what may go until so many bytes fit; false if they do not.
bool TileCache::make_room(std::uint64_t bytes) const {
  std::vector<Kept> files = kept();
  std::uint64_t total = bytes;
  for (const Kept& file : files) total += file.bytes;
  std::sort(files.begin(), files.end(),
            [](const Kept& a, const Kept& b) { return std::tie(a.own, a.used) < std::tie(b.own, b.used); });
  for (const Kept& file : files) {
    if (total <= most_bytes_) break;
    if (file.used >= begin_ || used_.contains(file.path.filename().string())) continue;
    std::error_code refused;
    fs::remove(file.path, refused);
    if (!refused) total -= file.bytes;
  }
  return total <= most_bytes_;
}

void TileCache::stop_writing(const Notice& why) {
  writing_ = false;
  notices_.push_back(why);
}

template <class Message>
void TileCache::write_named(const std::string& name, const Message& message) {
  {
    const std::scoped_lock lock(mutex_);
    if (!writing_) return;
  }
  const msg::Buffer payload = msg::encode_inline(msg::encode(message));
  std::string head = line_of(name, payload.bytes());
  head += padding(head.size(), payload) + "\n";
  std::vector<std::uint8_t> file(head.begin(), head.end());
  const auto* first = reinterpret_cast<const std::uint8_t*>(payload.data);
  file.insert(file.end(), first, first + payload.size);

  const fs::path path = folder_ / name, part = part_of(path);
  const std::scoped_lock lock(mutex_);
  if (!writing_) return;
  try {
    fs::create_directories(folder_);
    if (!make_room(file.size())) {
      return stop_writing({"tile_cache_full", fmt::format("folder={} most_bytes={}", folder_.string(), most_bytes_)});
    }
    tiles::write_file(part.string(), file);
    fs::rename(part, path);
  } catch (const std::exception& error) {
    std::error_code ignored;
    fs::remove(part, ignored);
    return stop_writing({"tile_cache_failed", fmt::format("why=\"{}\"", error.what())});
  }
  used_.insert(name);
  statistics_.written += std::is_same_v<Message, msg::Tile> ? 1 : 0;
}

void TileCache::write(const msg::Tile& tile) {
  write_named(name_of({static_cast<std::int32_t>(tile.col), static_cast<std::int32_t>(tile.row)}), tile);
}

void TileCache::write(const msg::Chart& chart) { write_named(name_of_chart(), chart); }

std::vector<TileCache::Notice> TileCache::take_notices() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(notices_, {});
}

TileCache::Statistics TileCache::statistics() const {
  const std::scoped_lock lock(mutex_);
  return statistics_;
}

}  // namespace ensonify::pager
