#include "components/record/repair.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "components/errors/exit_error.h"
#include "components/record/record_file.h"
#include "components/record/summary.h"

namespace ensonify::record {

namespace {

/// One pass over a record, from its start to its last whole chunk.
class Scan {
 public:
  explicit Scan(RecordFile& file) : file_(file), file_bytes_(file.size()) {
    read_start();
    while (read_next()) {
    }
  }

  bool is_whole() const { return is_whole_; }
  const Summary& summary() const { return summary_; }
  const RecordFile::Mark& end() const { return end_; }
  /// Where the first chunk stands, or would.
  std::uint64_t chunks_start() const { return chunks_start_.value_or(end_.size); }
  /// Index entries of the last chunk, if its indices are not all there.
  const ChunkEntries& missing_indices() const { return missing_indices_; }
  std::int64_t utc_start_ns() const { return utc_start_ns_; }

 private:
  struct Record {
    Op op{};
    std::vector<std::byte> head;
    std::vector<std::byte> content;
    std::uint64_t end = 0;
  };

  [[noreturn]] void refuse(const std::string& why) const {
    throw UserError(file_.path().string() + ": " + why + "; nothing was changed");
  }

  std::optional<Record> record_at(std::uint64_t at) const {
    if (at + kRecordHead > file_bytes_) return std::nullopt;
    Record record;
    record.head.resize(kRecordHead);
    file_.read(at, record.head);
    ByteSource in(record.head);
    record.op = static_cast<Op>(in.u8());
    const std::uint64_t size = in.u64();
    if (size > file_bytes_ - at - kRecordHead) return std::nullopt;  // so memory is bounded by the file
    record.content.resize(size);
    file_.read(at + kRecordHead, record.content);
    record.end = at + kRecordHead + size;
    return record;
  }

  void accept(const Record& record) {
    end_.crc = crc32(record.content, crc32(record.head, end_.crc));
    end_.size = record.end;
  }

  void read_start() {
    std::array<std::byte, kMcapMagic.size()> magic{};
    if (file_bytes_ >= magic.size()) file_.read(0, magic);
    if (std::memcmp(magic.data(), kMcapMagic.data(), magic.size()) != 0) refuse("is no record: it is not an MCAP file");
    end_ = {magic.size(), crc32(magic)};
    const auto header = record_at(end_.size);
    const auto info = header ? record_at(header->end) : std::nullopt;
    try {
      const bool ours = header && header->op == Op::header && ByteSource(header->content).text() == kProfile;
      if (!ours) refuse("is no record that Ensonify wrote");
      if (!info || info->op != Op::metadata) refuse("ends before the facts about its run: there is nothing to repair");
      read_info(ByteSource(info->content));
    } catch (const Malformed& error) {
      refuse(std::string("is no record: ") + error.what());
    }
    accept(*header);
  }

  void read_info(ByteSource in) {
    in.text();
    for (const auto& [key, value] : in.map()) {
      if (key != "utc_start_ns") continue;
      std::from_chars(value.data(), value.data() + value.size(), utc_start_ns_);
    }
  }

  bool read_next() {
    const auto record = record_at(end_.size);
    const auto at = "byte " + std::to_string(end_.size);
    if (!record) {
      if (!may_be_unfinished()) refuse("is damaged at " + at + ": a chunk contradicts its own length");
      return false;
    }
    try {
      switch (record->op) {
        case Op::metadata:
        case Op::attachment:
          summary_.add(record->op, end_.size, record->content);
          accept(*record);
          return true;
        case Op::chunk: return read_chunk(*record);
        case Op::data_end: is_whole_ = ends_well(record->end); return false;
        default: break;
      }
    } catch (const Malformed& error) {
      refuse("is damaged at " + at + ": " + error.what());
    }
    if (!is_blank_from(end_.size)) refuse("is damaged at " + at + ": there is no record of a known kind");
    return false;
  }

  /// A record that ends beyond the file was being written, or its length is damaged: then what follows must not be
  /// dropped. A chunk states its length twice.
  bool may_be_unfinished() const {
    constexpr std::size_t kLengthsAt = kRecordHead + 8 + 8;
    if (end_.size + kLengthsAt + 8 > file_bytes_) return true;
    const auto bytes = file_.read<kLengthsAt + 8>(end_.size);
    ByteSource in(bytes);
    if (static_cast<Op>(in.u8()) != Op::chunk) return true;
    const std::uint64_t length = in.u64();
    in.raw(8 + 8);
    return length == in.u64() + 8 + 8 + 8 + 4 + 4 + 8;
  }

  /// What a disk that lost its power leaves behind.
  bool is_blank_from(std::uint64_t at) const {
    std::vector<std::byte> piece(1U << 16U);
    for (; at < file_bytes_; at += piece.size()) {
      piece.resize(std::min<std::uint64_t>(piece.size(), file_bytes_ - at));
      file_.read(at, piece);
      if (std::any_of(piece.begin(), piece.end(), [](std::byte byte) { return byte != std::byte{0}; })) return false;
    }
    return true;
  }

  bool read_chunk(const Record& chunk) {
    ByteSource in(chunk.content);
    const std::uint64_t first = in.u64(), last = in.u64();
    in.u64();  // size
    const std::uint32_t crc = in.u32();
    if (!in.text().empty()) throw Malformed("a chunk is compressed");
    const auto records = in.raw(in.u64());
    if (crc != crc32(records)) {
      if (!is_blank_from(chunk.end)) throw Malformed("a chunk's checksum is wrong, and more follows it");
      return false;
    }
    const ChunkEntries entries = read_entries(records);
    if (!chunks_start_) chunks_start_ = end_.size;
    accept(chunk);
    summary_.add_chunk(first, last, entries);
    return read_indices(entries);
  }

  ChunkEntries read_entries(std::span<const std::byte> records) {
    ChunkEntries entries;
    for (ByteSource left(records); !left.empty();) {
      const std::uint64_t at = records.size() - left.left();
      const auto op = static_cast<Op>(left.u8());
      const auto content = left.raw(left.u64());
      if (op == Op::message) {
        ByteSource message(content);
        const std::uint16_t channel = message.u16();
        message.u32();
        if (!summary_.has_channel(channel)) throw Malformed("a message belongs to no topic");
        entries[channel].emplace_back(message.u64(), at);
      } else {
        summary_.add(op, 0, content);
      }
    }
    return entries;
  }

  bool read_indices(const ChunkEntries& entries) {
    const RecordFile::Mark chunk_end = end_;
    for (const auto& [channel, places] : entries) {
      const auto index = record_at(end_.size);
      const ByteSink wanted = message_index(channel, places);
      if (!index || index->op != Op::message_index || !std::ranges::equal(index->content, wanted.bytes())) {
        const std::uint64_t rest = index && index->op == Op::message_index ? index->end : end_.size;
        if (index && !is_blank_from(rest)) throw Malformed("a chunk's index is wrong, and more follows it");
        end_ = chunk_end;
        missing_indices_ = entries;
        return false;
      }
      accept(*index);
    }
    return true;
  }

  /// Whether summary, footer and magic follow the end of the data and end the file.
  bool ends_well(std::uint64_t summary_start) const {
    std::uint32_t crc = 0;
    for (std::uint64_t at = summary_start;;) {
      const auto record = record_at(at);
      if (!record) return false;
      at = record->end;
      if (record->op != Op::footer) {
        crc = crc32(record->content, crc32(record->head, crc));
        continue;
      }
      std::array<std::byte, kMcapMagic.size()> magic{};
      if (record->content.size() != 20 || record->end + magic.size() != file_bytes_) return false;
      file_.read(record->end, magic);
      crc = crc32(std::span(record->content).first(16), crc32(record->head, crc));
      return std::memcmp(magic.data(), kMcapMagic.data(), magic.size()) == 0 &&
             ByteSource(std::span(record->content).subspan(16)).u32() == crc;
    }
  }

  RecordFile& file_;
  std::uint64_t file_bytes_;
  Summary summary_;
  RecordFile::Mark end_;
  std::optional<std::uint64_t> chunks_start_;
  ChunkEntries missing_indices_;
  std::int64_t utc_start_ns_ = 0;
  bool is_whole_ = false;
};

}  // namespace

Repair repair(const std::filesystem::path& path) {
  RecordFile file(path, RecordFile::How::mend);
  const std::uint64_t found_bytes = file.size();
  const Scan scan(file);
  Repair repair;
  repair.was_whole = scan.is_whole();
  repair.messages = scan.summary().messages();
  repair.kept_bytes = scan.end().size;
  if (repair.messages > 0) {
    repair.last = SimTime{static_cast<std::int64_t>(scan.summary().last_time()) - scan.utc_start_ns()};
  }
  if (repair.was_whole) return repair;
  repair.dropped_bytes = found_bytes - repair.kept_bytes;
  file.cut_to(scan.end());
  try {
    put_message_indices(file, scan.missing_indices());
    scan.summary().put(file, scan.chunks_start());
  } catch (const DataLost&) {
    file.cut_to(scan.end());
    throw;
  }
  file.close();
  return repair;
}

}  // namespace ensonify::record
