#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ensonify::formats {

/// What is wrong in a file, and where.
struct Fault {
  std::uint64_t offset = 0;  // in bytes from the file's begin
  std::string cause;         // and what is allowed
};

/// The faults of one file. All are counted, the first kKept are kept: a damaged file may have millions.
class Faults {
 public:
  static constexpr std::size_t kKept = 100;

  void add(std::uint64_t offset, std::string cause) {
    ++count_;
    if (kept_.size() < kKept) kept_.push_back({offset, std::move(cause)});
  }
  void add_skipped(std::uint64_t bytes) { skipped_bytes_ += bytes; }

  std::uint64_t count() const { return count_; }
  const std::vector<Fault>& kept() const { return kept_; }
  /// Bytes that belong to no valid datagram.
  std::uint64_t skipped_bytes() const { return skipped_bytes_; }

 private:
  std::uint64_t count_ = 0;
  std::uint64_t skipped_bytes_ = 0;
  std::vector<Fault> kept_;
};

}  // namespace ensonify::formats
