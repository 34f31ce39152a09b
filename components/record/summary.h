#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "components/record/bytes.h"
#include "components/record/format.h"
#include "components/record/record_file.h"

namespace ensonify::record {

/// Messages of a chunk by channel: log time, offset in the chunk.
using ChunkEntries = std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>>;

void append_record(ByteSink& to, Op op, std::span<const std::byte> content);

/// Content of the message index of one channel.
ByteSink message_index(std::uint16_t channel, const ChunkEntries::mapped_type& places);

/// Appends the message indices that follow a chunk, one per channel.
void put_message_indices(RecordFile& file, const ChunkEntries& entries);

/// What the end of a record repeats of what stands before it, so that a reader need not go through all of it.
/// Holds nothing that grows with the number of chunks.
class Summary {
 public:
  /// A schema or channel (of a chunk), an attachment or metadata (at byte `start` of the file).
  void add(Op op, std::uint64_t start, std::span<const std::byte> content);
  /// A chunk whose messages have log times from `first` to `last`.
  void add_chunk(std::uint64_t first, std::uint64_t last, const ChunkEntries& entries);
  bool has_channel(std::uint16_t id) const { return counts_.count(id) > 0; }
  std::uint64_t messages() const { return total_; }
  std::uint64_t last_time() const { return last_; }

  /// Appends the end of the data, the summary and the footer to a file whose first chunk stands at `chunks_start`.
  void put(RecordFile& file, std::uint64_t chunks_start) const;

 private:
  ByteSink statistics() const;
  void put_chunk_index(RecordFile& file, std::uint64_t chunks_start) const;

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
  std::uint32_t metadata_count_ = 0;
  std::uint16_t schema_count_ = 0;
};

}  // namespace ensonify::record
