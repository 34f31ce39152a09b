#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "components/formats/bytes.h"

namespace ensonify::formats {

/// A file of any size, of which some bytes are in memory: those asked for, and kReadAhead bytes at least.
class Window {
 public:
  static constexpr std::size_t kReadAhead = 1U << 20U;

  /// Throws UserError for a file that cannot be opened, or is none (a folder, a device).
  explicit Window(const std::filesystem::path& file);
  /// Bytes that are in memory already and stay there.
  explicit Window(ByteView bytes) : size_(bytes.size()), memory_(bytes) {}
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  std::uint64_t size() const { return size_; }
  /// `count` bytes from `offset` on, fewer at the end of the file. They stay until the next call.
  ByteView at(std::uint64_t offset, std::size_t count);
  /// A look at up to kPeek bytes somewhere else: what at() gave stays where it is.
  static constexpr std::size_t kPeek = 32;
  ByteView peek(std::uint64_t offset, std::size_t count);
  /// Empty, or why the file could not be read further; it then ends there.
  const std::string& error() const { return error_; }

 private:
  void load(std::uint64_t offset, std::size_t count);

  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  ByteView memory_;  // of the file from begin_ on
  std::uint64_t begin_ = 0;
  Bytes buffer_;
  std::array<std::byte, kPeek> peeked_{};
  std::string error_;
};

/// Where `mark` stands next, `from` or later, less `before`; the size of the file where it does not.
std::uint64_t next_byte(Window& file, std::uint64_t from, std::byte mark, std::uint64_t before);

}  // namespace ensonify::formats
