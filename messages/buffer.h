#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace ensonify::msg {

/// Bytes that somebody keeps alive: a received frame, a vector, an array about to be sent. Copying shares them.
/// The bytes never change once a Buffer has been handed on.
struct Buffer {
  std::shared_ptr<const void> owner;
  const std::byte* data = nullptr;
  std::size_t size = 0;

  std::span<const std::byte> bytes() const { return {data, size}; }
  std::string_view text() const { return {reinterpret_cast<const char*>(data), size}; }

  /// Takes over a container of trivially copyable elements (std::vector, std::string).
  template <class Container>
  static Buffer own(Container container) {
    auto kept = std::make_shared<const Container>(std::move(container));
    const auto* first = reinterpret_cast<const std::byte*>(kept->data());
    const std::size_t count = kept->size() * sizeof(*kept->data());
    return {std::move(kept), first, count};
  }
};

inline bool same_bytes(const Buffer& a, const Buffer& b) {
  return a.size == b.size && (a.size == 0 || std::memcmp(a.data, b.data, a.size) == 0);
}

}  // namespace ensonify::msg
