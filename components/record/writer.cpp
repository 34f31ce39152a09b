#include "components/record/writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "components/errors/assert.h"
#include "components/record/bytes.h"

namespace ensonify::record {

namespace {

void append_record(ByteSink& to, Op op, const ByteSink& content) {
  to.u8(static_cast<std::uint8_t>(op));
  to.u64(content.size());
  to.raw(content.bytes());
}

std::string cause() { return std::strerror(errno); }

constexpr std::int64_t kSecond = 1'000'000'000;

}  // namespace

RecordWriter::RecordWriter(std::filesystem::path file, const RecordInfo& info,
                           const std::vector<Attachment>& attachments)
    : file_(std::move(file)), utc_start_ns_(info.utc_start_ns) {
  if (file_.has_parent_path()) {
    std::error_code error;
    std::filesystem::create_directories(file_.parent_path(), error);
    if (error) throw UserError(file_.string() + ": cannot make its folder: " + error.message());
  }
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw UserError(file_.string() + ": cannot be written: " + cause());
  try {
    put(std::as_bytes(std::span(kMcapMagic)));
    ByteSink header;
    header.text(kProfile);
    header.text("ensonify " + info.version);
    put_record(Op::header, header);
    put_info(info);
    for (const Attachment& attachment : attachments) put_attachment(attachment);
  } catch (...) {  // no destructor runs
    if (descriptor_ >= 0) ::close(descriptor_);
    throw;
  }
  chunks_start_ = whole_until_ = offset_;
  chunk_.reserve(kChunkBytes);
}

RecordWriter::~RecordWriter() {
  try {
    close();
  } catch (const DataLost&) {  // the owner has left: a truncated record is all that can be kept
  }
}

void RecordWriter::put(std::span<const std::byte> bytes) {
  crc_ = crc32(bytes, crc_);
  offset_ += bytes.size();
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("cannot be written further");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void RecordWriter::fail(const char* what) {
  const std::string text = file_.string() + ": " + what + ": " + cause() + "; " + std::to_string(whole_until_) +
                           " bytes are kept, to the last whole chunk";
  // Best effort: if even this fails, readers stop at the last whole chunk all the same.
  if (::ftruncate(descriptor_, static_cast<off_t>(whole_until_)) != 0) errno = 0;
  ::close(descriptor_);
  descriptor_ = -1;
  throw DataLost(text);
}

void RecordWriter::put_record(Op op, const ByteSink& content) {
  ByteSink head;
  head.u8(static_cast<std::uint8_t>(op));
  head.u64(content.size());
  put(head.bytes());
  put(content.bytes());
}

void RecordWriter::put_info(const RecordInfo& info) {
  const std::uint64_t start = offset_;
  ByteSink content;
  content.text(kInfoName);
  content.map({{"version", info.version},
               {"seed", std::to_string(info.seed)},
               {"utc_start_ns", std::to_string(info.utc_start_ns)}});
  put_record(Op::metadata, content);

  ByteSink index;
  index.u64(start);
  index.u64(offset_ - start);
  index.text(kInfoName);
  append_record(metadata_index_, Op::metadata_index, index);
}

void RecordWriter::put_attachment(const Attachment& attachment) {
  const std::uint64_t start = offset_;
  const auto time = static_cast<std::uint64_t>(utc_start_ns_);
  ByteSink content;
  content.u64(time);  // logged
  content.u64(time);  // created
  content.text(attachment.name);
  content.text(attachment.media_type);
  content.u64(attachment.data.size());
  content.raw(std::as_bytes(std::span(attachment.data)));
  content.u32(crc32(content.bytes()));
  put_record(Op::attachment, content);

  ByteSink index;
  index.u64(start);
  index.u64(offset_ - start);
  index.u64(time);
  index.u64(time);
  index.u64(attachment.data.size());
  index.text(attachment.name);
  index.text(attachment.media_type);
  append_record(attachment_index_, Op::attachment_index, index);
  ++attachment_count_;
}

void RecordWriter::add_channel(const Channel& channel) {
  std::uint16_t schema_id = 0;  // "no schema"
  if (!channel.schema.empty()) {
    const auto next = static_cast<std::uint16_t>(schema_ids_.size() + 1);
    const auto [known, is_new] = schema_ids_.emplace(channel.type, next);
    schema_id = known->second;
    if (is_new) {
      ByteSink schema;
      schema.u16(schema_id);
      schema.text(channel.type);
      schema.text(kSchemaEncoding);
      schema.text(channel.schema);
      append_record(chunk_, Op::schema, schema);
      append_record(schemas_, Op::schema, schema);
    }
  }
  ENSONIFY_ASSERT(counts_.emplace(channel.id, 0).second, "channel " + channel.topic + " stands twice");
  ByteSink content;
  content.u16(channel.id);
  content.u16(schema_id);
  content.text(channel.topic);
  content.text(kMessageEncoding);
  content.map({{"type", channel.type},
               {"rank", std::to_string(channel.rank)},
               {"max_bytes", std::to_string(channel.max_bytes)}});
  append_record(chunk_, Op::channel, content);
  append_record(channels_, Op::channel, content);
}

void RecordWriter::write(std::uint16_t channel, std::uint64_t seq, SimTime t_sim, const msg::Buffer& payload) {
  if (descriptor_ < 0) throw DataLost(file_.string() + ": is closed");
  const auto count = counts_.find(channel);
  ENSONIFY_ASSERT(count != counts_.end(), "no channel " + std::to_string(channel));
  const auto time = static_cast<std::uint64_t>(utc_start_ns_ + t_sim.count());
  const std::size_t content_bytes = 2 + 4 + 8 + 8 + payload.size;

  const std::int64_t second = t_sim.count() / kSecond;
  const bool full = chunk_.size() + kRecordHead + content_bytes > kChunkBytes;
  if (!chunk_entries_.empty() && (second != chunk_second_ || full)) end_chunk();
  if (chunk_entries_.empty()) {
    chunk_second_ = second;
    chunk_first_ = time;
  }
  chunk_last_ = time;
  if (total_++ == 0) first_ = time;
  last_ = time;
  ++count->second;

  chunk_entries_[channel].emplace_back(time, chunk_.size());
  chunk_.u8(static_cast<std::uint8_t>(Op::message));
  chunk_.u64(content_bytes);
  chunk_.u16(channel);
  chunk_.u32(static_cast<std::uint32_t>(seq));
  chunk_.u64(time);
  chunk_.u64(time);
  chunk_.raw(payload.bytes());
}

void RecordWriter::end_chunk() {
  ByteSink head;
  const std::uint64_t head_bytes = 8 + 8 + 8 + 4 + 4 + 8;
  head.u8(static_cast<std::uint8_t>(Op::chunk));
  head.u64(head_bytes + chunk_.size());
  head.u64(chunk_entries_.empty() ? 0 : chunk_first_);
  head.u64(chunk_entries_.empty() ? 0 : chunk_last_);
  head.u64(chunk_.size());
  head.u32(crc32(chunk_.bytes()));
  head.text("");  // not compressed
  head.u64(chunk_.size());
  put(head.bytes());
  put(chunk_.bytes());
  put_message_indices();
  whole_until_ = offset_;
  ++chunk_count_;
  chunk_.clear();
  chunk_entries_.clear();
}

void RecordWriter::put_message_indices() {
  for (const auto& [channel, entries] : chunk_entries_) {
    ByteSink content;
    content.u16(channel);
    content.u32(static_cast<std::uint32_t>(entries.size() * 16));
    for (const auto& [time, at] : entries) {
      content.u64(time);
      content.u64(at);
    }
    put_record(Op::message_index, content);
  }
}

template <std::size_t count>
std::array<std::byte, count> RecordWriter::read_back(std::uint64_t at) {
  std::array<std::byte, count> bytes;
  std::size_t have = 0;
  while (have < count) {
    const ssize_t got = ::pread(descriptor_, bytes.data() + have, count - have, static_cast<off_t>(at + have));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("cannot be read back");
    have += static_cast<std::size_t>(got);
  }
  return bytes;
}

/// The chunks' places are read back from the file: kept in memory they would grow with the record, for ever.
void RecordWriter::put_chunk_index() {
  constexpr std::size_t kEnough = 1U << 16U;  // bytes per write
  ByteSink index;
  std::uint64_t at = chunks_start_;
  for (std::uint32_t n = 0; n < chunk_count_; ++n) {
    append_record(index, Op::chunk_index, chunk_index_of(at));
    if (index.size() < kEnough) continue;
    put(index.bytes());
    index.clear();
  }
  put(index.bytes());
}

/// Of the chunk at `at`, which then is the end of the chunk's message indices.
ByteSink RecordWriter::chunk_index_of(std::uint64_t& at) {
  const std::uint64_t start = at;
  const auto chunk = read_back<kRecordHead + 24>(start);
  ByteSource in(chunk);
  in.u8();
  const std::uint64_t end = start + kRecordHead + in.u64();
  const std::uint64_t first = in.u64(), last = in.u64(), bytes = in.u64();

  ByteSink places;  // channel id -> offset of its message index
  for (at = end;;) {
    const auto next = read_back<kRecordHead + 2>(at);  // after the last chunk: the end of the data
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

void RecordWriter::put_summary() {
  ByteSink numbers;
  numbers.u64(total_);
  numbers.u16(static_cast<std::uint16_t>(schema_ids_.size()));
  numbers.u32(static_cast<std::uint32_t>(counts_.size()));
  numbers.u32(attachment_count_);
  numbers.u32(1);  // metadata
  numbers.u32(chunk_count_);
  numbers.u64(first_);
  numbers.u64(last_);
  numbers.u32(static_cast<std::uint32_t>(counts_.size() * 10));
  for (const auto& [channel, count] : counts_) {
    numbers.u16(channel);
    numbers.u64(count);
  }
  const std::uint64_t summary_start = offset_;
  crc_ = 0;
  ByteSink offsets;
  const auto put_group = [&](Op op, const auto& put_records) {
    const std::uint64_t start = offset_;
    put_records();
    if (offset_ == start) return;
    ByteSink content;
    content.u8(static_cast<std::uint8_t>(op));
    content.u64(start);
    content.u64(offset_ - start);
    append_record(offsets, Op::summary_offset, content);
  };
  put_group(Op::schema, [&] { put(schemas_.bytes()); });
  put_group(Op::channel, [&] { put(channels_.bytes()); });
  put_group(Op::statistics, [&] { put_record(Op::statistics, numbers); });
  put_group(Op::chunk_index, [&] { put_chunk_index(); });
  put_group(Op::attachment_index, [&] { put(attachment_index_.bytes()); });
  put_group(Op::metadata_index, [&] { put(metadata_index_.bytes()); });
  const std::uint64_t offsets_start = offset_;
  put(offsets.bytes());

  ByteSink footer;
  footer.u8(static_cast<std::uint8_t>(Op::footer));
  footer.u64(8 + 8 + 4);
  footer.u64(summary_start);
  footer.u64(offsets_start);
  put(footer.bytes());
  ByteSink end;
  end.u32(crc_);
  put(end.bytes());
  put(std::as_bytes(std::span(kMcapMagic)));
}

void RecordWriter::close() {
  if (descriptor_ < 0) return;
  if (!chunk_.empty()) end_chunk();
  ByteSink data_end;
  data_end.u32(crc_);
  put_record(Op::data_end, data_end);
  put_summary();
  if (::close(descriptor_) != 0) {
    descriptor_ = -1;
    throw DataLost(file_.string() + ": cannot be closed: " + cause());
  }
  descriptor_ = -1;
}

}  // namespace ensonify::record
