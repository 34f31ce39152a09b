#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/record/bytes.h"
#include "components/record/format.h"
#include "components/record/record_file.h"
#include "components/record/summary.h"
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
  /// Throws DataLost if the disk takes no more: the file then ends with its last whole chunk, and with the summary of
  /// what it holds if there is room for that.
  void write(std::uint16_t channel, std::uint64_t seq, SimTime t_sim, const msg::Buffer& payload);

  /// Writes the last chunk, the summary and the footer. Throws DataLost like write().
  void close();
  /// The same with a metadata record behind the last chunk, for what is known at the end alone.
  void close_with(const std::string& metadata, const TextMap& map);

  const std::filesystem::path& file() const { return file_.path(); }
  std::uint64_t message_count() const { return written_; }

 private:
  void put_attachment(const Attachment& attachment);
  void put_info(const RecordInfo& info);
  void put_record(Op op, const ByteSink& content);
  void end_chunk();
  [[noreturn]] void end_early(const DataLost& cause);

  RecordFile file_;
  Summary summary_;
  RecordFile::Mark whole_;          // end of the last whole chunk with its indices
  std::uint64_t chunks_start_ = 0;  // the first chunk
  std::int64_t utc_start_ns_ = 0;
  std::uint64_t written_ = 0;

  ByteSink chunk_;
  std::int64_t chunk_second_ = 0;
  std::uint64_t chunk_first_ = 0;
  std::uint64_t chunk_last_ = 0;
  ChunkEntries chunk_entries_;
  std::map<std::string, std::uint16_t> schema_ids_;
};

}  // namespace ensonify::record
