#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

#include "components/record/bytes.h"
#include "components/record/format.h"

namespace ensonify::record {

/// A record as a file that grows at its end, with the checksum of what it holds. Open, it is locked: two runs with one
/// output folder, or a repair beside a run, are refused instead of mixing their bytes.
class RecordFile {
 public:
  enum class How { create, mend };

  /// Creates the file and the folders above it, or empties it; to mend, opens what is there. Throws UserError, naming
  /// the file and the cause, if that fails or somebody else writes the file.
  RecordFile(std::filesystem::path path, How how);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;

  /// Appends. Throws DataLost, naming the file and the cause, if the disk takes no more.
  void put(std::span<const std::byte> bytes);
  void put_record(Op op, std::span<const std::byte> content);

  /// Bytes at an offset. Throws DataLost if they cannot be read.
  void read(std::uint64_t at, std::span<std::byte> bytes) const;
  template <std::size_t count>
  std::array<std::byte, count> read(std::uint64_t at) const {
    std::array<std::byte, count> bytes;
    read(at, bytes);
    return bytes;
  }

  /// An end that the file can be cut back to.
  struct Mark {
    std::uint64_t size = 0;
    std::uint32_t crc = 0;
  };
  Mark mark() const { return at_; }
  /// Best effort: where even this fails, readers stop at the last whole chunk all the same.
  void cut_to(Mark mark);
  void restart_crc() { at_.crc = 0; }

  bool is_open() const { return descriptor_ >= 0; }
  /// Throws DataLost if what was written did not arrive (network disks say so here).
  void close();

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return at_.size; }
  std::uint32_t crc() const { return at_.crc; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  Mark at_;
};

}  // namespace ensonify::record
