#include "components/record/writer.h"

#include "components/errors/assert.h"

namespace ensonify::record {

namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

}  // namespace

RecordWriter::RecordWriter(std::filesystem::path file, const RecordInfo& info,
                           const std::vector<Attachment>& attachments)
    : file_(std::move(file), RecordFile::How::create), utc_start_ns_(info.utc_start_ns) {
  file_.put(std::as_bytes(std::span(kMcapMagic)));
  ByteSink header;
  header.text(kProfile);
  header.text("ensonify " + info.version);
  file_.put_record(Op::header, header.bytes());
  put_info(info);
  for (const Attachment& attachment : attachments) put_attachment(attachment);
  whole_ = file_.mark();
  chunks_start_ = whole_.size;
  chunk_.reserve(kChunkBytes);
}

RecordWriter::~RecordWriter() {
  try {
    close();
  } catch (const DataLost&) {  // the owner has left: a truncated record is all that can be kept
  }
}

/// Outside chunks, where the summary has its place.
void RecordWriter::put_record(Op op, const ByteSink& content) {
  summary_.add(op, file_.size(), content.bytes());
  file_.put_record(op, content.bytes());
}

void RecordWriter::put_info(const RecordInfo& info) {
  ByteSink content;
  content.text(kInfoName);
  content.map({{"version", info.version},
               {"seed", std::to_string(info.seed)},
               {"utc_start_ns", std::to_string(info.utc_start_ns)}});
  put_record(Op::metadata, content);
}

void RecordWriter::put_attachment(const Attachment& attachment) {
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
}

void RecordWriter::add_channel(const Channel& channel) {
  const auto put_in_chunk = [this](Op op, const ByteSink& content) {
    append_record(chunk_, op, content.bytes());
    summary_.add(op, 0, content.bytes());
  };
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
      put_in_chunk(Op::schema, schema);
    }
  }
  ENSONIFY_ASSERT(!summary_.has_channel(channel.id), "channel " + channel.topic + " stands twice");
  ByteSink content;
  content.u16(channel.id);
  content.u16(schema_id);
  content.text(channel.topic);
  content.text(kMessageEncoding);
  content.map({{"type", channel.type},
               {"rank", std::to_string(channel.rank)},
               {"max_bytes", std::to_string(channel.max_bytes)}});
  put_in_chunk(Op::channel, content);
}

void RecordWriter::write(std::uint16_t channel, std::uint64_t seq, SimTime t_sim, const msg::Buffer& payload) {
  if (!file_.is_open()) throw DataLost(file_.path().string() + ": is closed");
  ENSONIFY_ASSERT(summary_.has_channel(channel), "no channel " + std::to_string(channel));
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
  ++written_;

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
  const bool empty = chunk_entries_.empty();
  ByteSink head;
  const std::uint64_t head_bytes = 8 + 8 + 8 + 4 + 4 + 8;
  head.u8(static_cast<std::uint8_t>(Op::chunk));
  head.u64(head_bytes + chunk_.size());
  head.u64(empty ? 0 : chunk_first_);
  head.u64(empty ? 0 : chunk_last_);
  head.u64(chunk_.size());
  head.u32(crc32(chunk_.bytes()));
  head.text("");  // not compressed
  head.u64(chunk_.size());
  try {
    file_.put(head.bytes());
    file_.put(chunk_.bytes());
    put_message_indices(file_, chunk_entries_);
  } catch (const DataLost& cause) {
    end_early(cause);
  }
  whole_ = file_.mark();
  summary_.add_chunk(chunk_first_, chunk_last_, chunk_entries_);
  chunk_.clear();
  chunk_entries_.clear();
}

/// Cuts what does not fit; the room that it took is usually enough for the summary of the rest.
void RecordWriter::end_early(const DataLost& cause) {
  std::string end = ", with its index";
  file_.cut_to(whole_);
  try {
    summary_.put(file_, chunks_start_);
  } catch (const DataLost&) {
    file_.cut_to(whole_);
    end = "; once there is room, `ensonify record repair` adds the index";
  }
  file_.close();
  throw DataLost(std::string(cause.what()) + "; " + std::to_string(whole_.size) +
                 " bytes are kept, to the last whole chunk" + end);
}

void RecordWriter::close() { close_with("", {}); }

void RecordWriter::close_with(const std::string& metadata, const TextMap& map) {
  if (!file_.is_open()) return;
  if (!chunk_.empty()) end_chunk();
  try {
    if (!metadata.empty()) {
      ByteSink content;
      content.text(metadata);
      content.map(map);
      put_record(Op::metadata, content);
    }
    summary_.put(file_, chunks_start_);
  } catch (const DataLost& cause) {
    end_early(cause);
  }
  file_.close();
}

}  // namespace ensonify::record
