#include "components/record/reader.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "components/record/bytes.h"

namespace ensonify::record {

namespace {

template <class Integer>
Integer number_in(const TextMap& map, const char* key) {
  const auto found = std::find_if(map.begin(), map.end(), [&](const auto& entry) { return entry.first == key; });
  if (found == map.end()) throw Malformed(std::string("it has no ") + key);
  const std::string& text = found->second;
  Integer value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) throw Malformed(std::string(key) + " is not a number");
  return value;
}

std::string text_in(const TextMap& map, const char* key) {
  const auto found = std::find_if(map.begin(), map.end(), [&](const auto& entry) { return entry.first == key; });
  return found == map.end() ? std::string{} : found->second;
}

}  // namespace

RecordReader::RecordReader(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat facts {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &facts) != 0) {
    const std::string cause = std::strerror(errno);
    if (descriptor_ >= 0) ::close(descriptor_);
    throw UserError(file_.string() + ": cannot be read: " + cause);
  }
  file_bytes_ = S_ISREG(facts.st_mode) ? static_cast<std::uint64_t>(facts.st_size) : 0;
  try {
    const auto magic = take(kMcapMagic.size());
    if (std::memcmp(magic.data(), kMcapMagic.data(), magic.size()) != 0) throw Malformed("it is not an MCAP file");
    const Head head = take_head();
    if (head.op != Op::header) throw Malformed("it has no header");
    const auto header = take(head.size);
    const std::string profile = ByteSource(header).text();
    if (profile != kProfile) {
      throw Malformed("its format is \"" + profile + "\", this program reads \"" + kProfile + "\"");
    }
    next_chunk();
    if (!has_info_ && !truncated_.empty()) throw Malformed(truncated_);
    if (!has_info_) throw Malformed("it has no facts about its run");
  } catch (const Malformed& error) {
    ::close(descriptor_);
    throw UserError(file_.string() + ": is no record: " + error.what());
  }
}

RecordReader::~RecordReader() { ::close(descriptor_); }

std::vector<std::byte> RecordReader::take(std::uint64_t count) {
  if (count > file_bytes_ - offset_) throw Malformed("it ends within a record");  // so memory is bounded by the file
  std::vector<std::byte> bytes(static_cast<std::size_t>(count));
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data() + have, bytes.size() - have, static_cast<off_t>(offset_ + have));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw Malformed(std::string("it cannot be read further: ") + std::strerror(errno));
    if (got == 0) throw Malformed("it became shorter while it was read");
    have += static_cast<std::size_t>(got);
  }
  offset_ += count;
  return bytes;
}

RecordReader::Head RecordReader::take_head() {
  const auto bytes = take(kRecordHead);
  ByteSource in(bytes);
  const auto op = static_cast<Op>(in.u8());
  return {op, in.u64()};
}

void RecordReader::skip(std::uint64_t count) {
  if (count > file_bytes_ - offset_) throw Malformed("it ends within a record");
  offset_ += count;
}

bool RecordReader::next_chunk() {
  std::uint64_t start = offset_;
  try {
    while (!ended_) {
      start = offset_;
      if (offset_ == file_bytes_) throw Malformed("it has no end; its writer was stopped");
      const Head head = take_head();
      switch (head.op) {
        case Op::chunk: read_chunk(take(head.size)); return true;
        case Op::data_end:  // what follows repeats what has been read
          ended_ = true;
          break;
        case Op::metadata:
        case Op::attachment:
        case Op::schema:
        case Op::channel: read_record(head.op, take(head.size)); break;
        case Op::message: throw Malformed("it holds a message outside a chunk");
        default: skip(head.size);
      }
    }
  } catch (const Malformed& error) {
    truncated_ = "at byte " + std::to_string(start) + " of " + std::to_string(file_bytes_) + ": " + error.what();
    ended_ = true;
  }
  return false;
}

void RecordReader::read_record(Op op, std::span<const std::byte> content) {
  const ByteSource in(content);
  if (op == Op::schema) read_schema(in);
  if (op == Op::channel) read_channel(in);
  if (op == Op::metadata) read_info(in);
  if (op == Op::attachment) read_attachment(content);
}

void RecordReader::read_info(ByteSource in) {
  if (in.text() != kInfoName) return;
  const TextMap map = in.map();
  info_ = {text_in(map, "version"), number_in<std::uint64_t>(map, "seed"),
           number_in<std::int64_t>(map, "utc_start_ns")};
  has_info_ = true;
}

void RecordReader::read_attachment(std::span<const std::byte> content) {
  ByteSource in(content);
  in.u64();
  in.u64();
  Attachment attachment{in.text(), in.text(), {}};
  const auto data = in.raw(in.u64());
  attachment.data.assign(reinterpret_cast<const char*>(data.data()), data.size());
  const std::size_t checked = content.size() - in.left();
  const std::uint32_t crc = in.u32();
  if (crc != 0 && crc != crc32(content.first(checked)))
    throw Malformed("attachment " + attachment.name + " is damaged");
  attachments_.push_back(std::move(attachment));
}

void RecordReader::read_schema(ByteSource in) {
  const std::uint16_t id = in.u16();
  in.text();  // name
  in.text();  // encoding
  schemas_[id] = in.text();
}

void RecordReader::read_channel(ByteSource in) {
  Channel channel;
  channel.id = in.u16();
  const std::uint16_t schema = in.u16();
  channel.topic = in.text();
  if (in.text() != kMessageEncoding) throw Malformed("topic " + channel.topic + " is not encoded as msgpack");
  const TextMap map = in.map();
  channel.type = text_in(map, "type");
  channel.rank = number_in<std::uint32_t>(map, "rank");
  channel.max_bytes = number_in<std::size_t>(map, "max_bytes");
  if (const auto found = schemas_.find(schema); found != schemas_.end()) channel.schema = found->second;
  channels_.emplace(channel.id, std::move(channel));
}

void RecordReader::read_chunk(std::vector<std::byte> content) {
  auto chunk = std::make_shared<const std::vector<std::byte>>(std::move(content));
  ByteSource in(*chunk);
  in.u64();  // first time
  in.u64();  // last time
  in.u64();  // size
  const std::uint32_t crc = in.u32();
  if (!in.text().empty()) throw Malformed("a chunk is compressed");
  const auto records = in.raw(in.u64());
  if (crc != 0 && crc != crc32(records)) throw Malformed("a chunk is damaged (checksum)");

  // Topics first, so that a reader knows them all before the first message.
  for (ByteSource left(records); !left.empty();) {
    const auto op = static_cast<Op>(left.u8());
    const auto record = left.raw(left.u64());
    if (op == Op::schema) read_schema(ByteSource(record));
    if (op == Op::channel) read_channel(ByteSource(record));
  }
  chunk_ = std::move(chunk);
  chunk_left_ = ByteSource(records);
}

bool RecordReader::read_message(ByteSource in, RecordedMessage& message) {
  const auto channel = channels_.find(in.u16());
  if (channel == channels_.end()) throw Malformed("a message belongs to no topic");
  message.channel = &channel->second;
  message.seq = in.u32();
  const std::uint64_t log_time = in.u64();
  in.u64();  // publish time, the same
  message.t_sim = SimTime{static_cast<std::int64_t>(log_time - static_cast<std::uint64_t>(info_.utc_start_ns))};
  message.payload = {chunk_, in.rest().data(), in.rest().size()};
  return true;
}

bool RecordReader::next(RecordedMessage& message) {
  while (true) {
    try {
      while (!chunk_left_.empty()) {
        const auto op = static_cast<Op>(chunk_left_.u8());
        const auto record = chunk_left_.raw(chunk_left_.u64());
        if (op == Op::message) return read_message(ByteSource(record), message);
      }
    } catch (const Malformed& error) {
      truncated_ = "before byte " + std::to_string(offset_) + ": " + error.what();
      chunk_left_ = ByteSource{{}};
      ended_ = true;
      return false;
    }
    if (!next_chunk()) return false;
  }
}

}  // namespace ensonify::record
