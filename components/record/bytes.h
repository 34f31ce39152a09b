#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// MCAP's serialisation: little-endian integers, texts and maps with their length in bytes before them.
namespace ensonify::record {

using TextMap = std::vector<std::pair<std::string, std::string>>;

/// Appends fields to a growing byte string.
class ByteSink {
 public:
  template <class Integer>
  void number(Integer value) {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof value);
  }
  void u8(std::uint8_t value) { number(value); }
  void u16(std::uint16_t value) { number(value); }
  void u32(std::uint32_t value) { number(value); }
  void u64(std::uint64_t value) { number(value); }
  void raw(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  void text(std::string_view text) {
    u32(static_cast<std::uint32_t>(text.size()));
    raw(std::as_bytes(std::span(text)));
  }
  void map(const TextMap& map) {
    ByteSink entries;
    for (const auto& [key, value] : map) {
      entries.text(key);
      entries.text(value);
    }
    u32(static_cast<std::uint32_t>(entries.size()));
    raw(entries.bytes());
  }

  std::size_t size() const { return bytes_.size(); }
  bool empty() const { return bytes_.empty(); }
  void reserve(std::size_t count) { bytes_.reserve(count); }
  void clear() { bytes_.clear(); }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Bytes that are not what the specification says.
struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Takes fields from the front of a byte string; throws Malformed instead of reading beyond its end.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> bytes) : left_(bytes) {}

  template <class Integer>
  Integer number() {
    Integer value;
    std::memcpy(&value, raw(sizeof value).data(), sizeof value);
    return value;
  }
  std::uint8_t u8() { return number<std::uint8_t>(); }
  std::uint16_t u16() { return number<std::uint16_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::uint64_t u64() { return number<std::uint64_t>(); }
  std::span<const std::byte> raw(std::uint64_t count) {
    if (count > left_.size()) throw Malformed("a field is longer than its record");
    const auto taken = left_.first(static_cast<std::size_t>(count));
    left_ = left_.subspan(taken.size());
    return taken;
  }
  std::string text() {
    const auto taken = raw(u32());
    return {reinterpret_cast<const char*>(taken.data()), taken.size()};
  }
  TextMap map() {
    ByteSource entries(raw(u32()));
    TextMap map;
    while (!entries.empty()) {
      std::string key = entries.text();
      map.emplace_back(std::move(key), entries.text());
    }
    return map;
  }

  bool empty() const { return left_.empty(); }
  std::size_t left() const { return left_.size(); }
  std::span<const std::byte> rest() const { return left_; }

 private:
  std::span<const std::byte> left_;
};

/// CRC-32 of MCAP, zlib and Ethernet (reflected polynomial 0xEDB88320) of `bytes`, which follow what gave `before`.
inline std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0) {
  if (bytes.empty()) return before;  // of no bytes at no address zlib gives 0, whatever came before
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace ensonify::record
