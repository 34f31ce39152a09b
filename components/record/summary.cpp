#include "components/record/summary.h"

namespace ensonify::record {

namespace {

/// Of the chunk at `at`, which then is the end of the chunk's message indices.
ByteSink chunk_index_of(const RecordFile& file, std::uint64_t& at) {
  const std::uint64_t start = at;
  const auto chunk = file.read<kRecordHead + 24>(start);
  ByteSource in(chunk);
  in.u8();
  const std::uint64_t end = start + kRecordHead + in.u64();
  const std::uint64_t first = in.u64(), last = in.u64(), bytes = in.u64();

  ByteSink places;  // channel id -> offset of its message index
  for (at = end;;) {
    const auto next = file.read<kRecordHead + 2>(at);  // after the last chunk: the end of the data
    ByteSource of(next);
    if (static_cast<Op>(of.u8()) != Op::message_index) break;
    const std::uint64_t content = of.u64();
    places.u16(of.u16());
    places.u64(at);
    at += kRecordHead + content;
  }

  ByteSink index;
  index.u64(first);
  index.u64(last);
  index.u64(start);
  index.u64(end - start);
  index.u32(static_cast<std::uint32_t>(places.size()));
  index.raw(places.bytes());
  index.u64(at - end);
  index.text("");
  index.u64(bytes);
  index.u64(bytes);
  return index;
}

}  // namespace

void append_record(ByteSink& to, Op op, std::span<const std::byte> content) {
  to.u8(static_cast<std::uint8_t>(op));
  to.u64(content.size());
  to.raw(content);
}

ByteSink message_index(std::uint16_t channel, const ChunkEntries::mapped_type& places) {
  ByteSink content;
  content.u16(channel);
  content.u32(static_cast<std::uint32_t>(places.size() * 16));
  for (const auto& [time, at] : places) {
    content.u64(time);
    content.u64(at);
  }
  return content;
}

void put_message_indices(RecordFile& file, const ChunkEntries& entries) {
  for (const auto& [channel, places] : entries) {
    file.put_record(Op::message_index, message_index(channel, places).bytes());
  }
}

void Summary::add(Op op, std::uint64_t start, std::span<const std::byte> content) {
  ByteSource in(content);
  ByteSink index;
  index.u64(start);
  index.u64(kRecordHead + content.size());
  switch (op) {
    case Op::schema:
      append_record(schemas_, op, content);
      ++schema_count_;
      break;
    case Op::channel:
      append_record(channels_, op, content);
      counts_.emplace(in.u16(), 0);
      break;
    case Op::attachment: {
      const std::uint64_t logged = in.u64(), created = in.u64();
      const std::string name = in.text(), media_type = in.text();
      index.u64(logged);
      index.u64(created);
      index.u64(in.u64());
      index.text(name);
      index.text(media_type);
      append_record(attachment_index_, Op::attachment_index, index.bytes());
      ++attachment_count_;
      break;
    }
    case Op::metadata:
      index.text(in.text());
      append_record(metadata_index_, Op::metadata_index, index.bytes());
      ++metadata_count_;
      break;
    default: break;
  }
}

void Summary::add_chunk(std::uint64_t first, std::uint64_t last, const ChunkEntries& entries) {
  ++chunk_count_;
  if (entries.empty()) return;
  if (total_ == 0) first_ = first;
  last_ = last;
  for (const auto& [channel, places] : entries) {
    counts_[channel] += places.size();
    total_ += places.size();
  }
}

ByteSink Summary::statistics() const {
  ByteSink numbers;
  numbers.u64(total_);
  numbers.u16(schema_count_);
  numbers.u32(static_cast<std::uint32_t>(counts_.size()));
  numbers.u32(attachment_count_);
  numbers.u32(metadata_count_);
  numbers.u32(chunk_count_);
  numbers.u64(first_);
  numbers.u64(last_);
  numbers.u32(static_cast<std::uint32_t>(counts_.size() * 10));
  for (const auto& [channel, count] : counts_) {
    numbers.u16(channel);
    numbers.u64(count);
  }
  return numbers;
}

/// The chunks' places are read back from the file: kept in memory they would grow with the record, for ever.
void Summary::put_chunk_index(RecordFile& file, std::uint64_t chunks_start) const {
  constexpr std::size_t kEnough = 1U << 16U;  // bytes per write
  ByteSink index;
  std::uint64_t at = chunks_start;
  for (std::uint32_t n = 0; n < chunk_count_; ++n) {
    append_record(index, Op::chunk_index, chunk_index_of(file, at).bytes());
    if (index.size() < kEnough) continue;
    file.put(index.bytes());
    index.clear();
  }
  file.put(index.bytes());
}

void Summary::put(RecordFile& file, std::uint64_t chunks_start) const {
  ByteSink data_end;
  data_end.u32(file.crc());
  file.put_record(Op::data_end, data_end.bytes());

  const std::uint64_t summary_start = file.size();
  file.restart_crc();
  ByteSink offsets;
  const auto put_group = [&](Op op, const auto& put_records) {
    const std::uint64_t start = file.size();
    put_records();
    if (file.size() == start) return;
    ByteSink content;
    content.u8(static_cast<std::uint8_t>(op));
    content.u64(start);
    content.u64(file.size() - start);
    append_record(offsets, Op::summary_offset, content.bytes());
  };
  put_group(Op::schema, [&] { file.put(schemas_.bytes()); });
  put_group(Op::channel, [&] { file.put(channels_.bytes()); });
  put_group(Op::statistics, [&] { file.put_record(Op::statistics, statistics().bytes()); });
  put_group(Op::chunk_index, [&] { put_chunk_index(file, chunks_start); });
  put_group(Op::attachment_index, [&] { file.put(attachment_index_.bytes()); });
  put_group(Op::metadata_index, [&] { file.put(metadata_index_.bytes()); });
  const std::uint64_t offsets_start = file.size();
  file.put(offsets.bytes());

  ByteSink footer;
  footer.u8(static_cast<std::uint8_t>(Op::footer));
  footer.u64(8 + 8 + 4);
  footer.u64(summary_start);
  footer.u64(offsets_start);
  file.put(footer.bytes());
  ByteSink end;
  end.u32(file.crc());
  file.put(end.bytes());
  file.put(std::as_bytes(std::span(kMcapMagic)));
}

}  // namespace ensonify::record
