#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/record/bytes.h"
#include "components/record/format.h"
#include "components/runtime/sim_time.h"
#include "messages/buffer.h"

namespace ensonify::record {

/// A message of a record. The payload shares the memory of its chunk.
struct RecordedMessage {
  const Channel* channel = nullptr;  // lives as long as the reader
  std::uint32_t seq = 0;
  SimTime t_sim{0};
  msg::Buffer payload;  // for msg::decode_inline
};

/// Reads a record front to back, one chunk in memory at a time. Everything is checked: a damaged or foreign file gives
/// an error, never a crash.
class RecordReader {
 public:
  /// Reads up to the first chunk. Throws UserError for a file that cannot be read or is no record of a known major.
  explicit RecordReader(std::filesystem::path file);
  ~RecordReader();
  RecordReader(const RecordReader&) = delete;
  RecordReader& operator=(const RecordReader&) = delete;

  const RecordInfo& info() const { return info_; }
  const std::vector<Attachment>& attachments() const { return attachments_; }
  /// Topics so far, by id. Those that were known when the record began are all there after opening.
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }

  /// The next message in the order of the file; false at the end of the record, or of what is left of it.
  bool next(RecordedMessage& message);

  /// After next() gave false: empty, or where and why the record ends early (its writer was stopped, the disk was full,
  /// the file is damaged). All that was read before stands.
  const std::string& truncated() const { return truncated_; }

 private:
  struct Head {
    Op op;
    std::uint64_t size;
  };

  std::vector<std::byte> take(std::uint64_t count);
  Head take_head();
  void skip(std::uint64_t count);
  bool next_chunk();
  void read_record(Op op, std::span<const std::byte> content);
  void read_chunk(std::vector<std::byte> content);
  void read_schema(ByteSource in);
  void read_channel(ByteSource in);
  void read_info(ByteSource in);
  void read_attachment(std::span<const std::byte> content);
  bool read_message(ByteSource in, RecordedMessage& message);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t file_bytes_ = 0;
  std::uint64_t offset_ = 0;
  bool ended_ = false;
  std::string truncated_;

  RecordInfo info_;
  bool has_info_ = false;
  std::vector<Attachment> attachments_;
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, Channel> channels_;

  std::shared_ptr<const std::vector<std::byte>> chunk_;
  ByteSource chunk_left_{{}};
};

}  // namespace ensonify::record
