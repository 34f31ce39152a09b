#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

/// Little-endian numbers out of bytes and into bytes. Every format of this room is little-endian.
namespace ensonify::formats {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they stand");

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

/// Takes numbers from the front of a byte string. Beyond its end it gives zeros and says so by failed(): the reader
/// of a datagram asks once, at its end.
class ByteSource {
 public:
  explicit ByteSource(ByteView bytes) : left_(bytes) {}

  template <class Number>
  Number number() {
    static_assert(std::is_arithmetic_v<Number>);
    Number value{};
    if (const ByteView bytes = take(sizeof value); !bytes.empty()) std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  /// The next `count` bytes; none, and failed(), where fewer are left.
  ByteView take(std::uint64_t count) {
    if (count > left_.size()) {
      fail();
      return {};
    }
    const ByteView taken = left_.first(static_cast<std::size_t>(count));
    left_ = left_.subspan(taken.size());
    return taken;
  }

  void fail() {
    failed_ = true;
    left_ = {};
  }
  bool failed() const { return failed_; }
  ByteView left() const { return left_; }

 private:
  ByteView left_;
  bool failed_ = false;
};

/// Appends a number as it stands in a file.
template <class Number>
void append_number(Bytes& bytes, Number value) {
  static_assert(std::is_arithmetic_v<Number>);
  const auto* first = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof value);
}

/// Replaces the number at `at`, which is there already: a length that is known only at the end.
template <class Number>
void replace_number(Bytes& bytes, std::size_t at, Number value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace ensonify::formats
