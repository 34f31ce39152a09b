#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/record/bytes.h"
#include "components/record/format.h"
#include "components/runtime/sim_time.h"
#include "messages/buffer.h"

namespace ensonify::record {

/// Writes a record front to back. Holds one chunk in memory and nothing of those before it, however long the record.
/// Until close() the file is a truncated record: readable to its last whole chunk.
class RecordWriter {
 public:
  /// Creates the file and the folders above it. Throws UserError, naming the file and the cause, if that fails.
  RecordWriter(std::filesystem::path file, const RecordInfo& info, const std::vector<Attachment>& attachments = {});
  /// Closes, if the owner has not; what goes wrong then stays a truncated record.
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  /// Before the first message of the topic. Topics of one type share its schema.
  void add_channel(const Channel& channel);

  /// Appends a message; `payload` is msg::encode_inline of its body. Times of successive messages never decrease.
  /// Throws DataLost, after cutting the file back to its last whole chunk, if the disk takes no more.
  void write(std::uint16_t channel, std::uint64_t seq, SimTime t_sim, const msg::Buffer& payload);

  /// Writes the last chunk, the summary and the footer. Throws DataLost like write().
  void close();

  const std::filesystem::path& file() const { return file_; }
  std::uint64_t message_count() const { return total_; }

 private:
  using IndexEntries = std::vector<std::pair<std::uint64_t, std::uint64_t>>;  // log time, offset in chunk

  void put(std::span<const std::byte> bytes);
  void put_record(Op op, const ByteSink& content);
  void put_attachment(const Attachment& attachment);
  void put_info(const RecordInfo& info);
  void put_message_indices();
  void put_chunk_index();
  ByteSink chunk_index_of(std::uint64_t& at);
  void put_summary();
  template <std::size_t count>
  std::array<std::byte, count> read_back(std::uint64_t at);
  void end_chunk();
  void fail(const char* what);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t offset_ = 0;        // bytes written
  std::uint64_t whole_until_ = 0;   // end of the last whole chunk with its indices
  std::uint64_t chunks_start_ = 0;  // the first chunk
  std::uint32_t crc_ = 0;           // of everything written, restarted for the summary
  std::int64_t utc_start_ns_ = 0;

  ByteSink chunk_;
  std::int64_t chunk_second_ = 0;
  std::uint64_t chunk_first_ = 0;
  std::uint64_t chunk_last_ = 0;
  std::map<std::uint16_t, IndexEntries> chunk_entries_;

  // Collected for the summary.
  std::map<std::string, std::uint16_t> schema_ids_;
  ByteSink schemas_;
  ByteSink channels_;
  ByteSink attachment_index_;
  ByteSink metadata_index_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::uint64_t total_ = 0;
  std::uint64_t first_ = 0;
  std::uint64_t last_ = 0;
  std::uint32_t chunk_count_ = 0;
  std::uint32_t attachment_count_ = 0;
};

}  // namespace ensonify::record
