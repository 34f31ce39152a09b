#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// Format of a record: an MCAP file (https://mcap.dev/spec, major 0, profile below). One channel per topic, payloads
/// are msgpack maps with their arrays inside (msg::encode_inline), and
///
///   log_time = publish_time = UTC of the scenario's start + t_sim, sequence = low 32 bits of seq.
///
/// Nothing in it depends on wall time, host, run or path: two records of the same run are equal byte by byte.
namespace ensonify::record {

inline constexpr std::array<unsigned char, 8> kMcapMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
inline constexpr const char* kProfile = "x-ensonify/1";  // the number is the major of the record format
inline constexpr const char* kInfoName = "ensonify";     // name of the metadata record
inline constexpr const char* kMessageEncoding = "msgpack";
inline constexpr const char* kSchemaEncoding = "jsonschema";

/// A chunk ends at each full second of sim time and before it would grow beyond this, unless one message is larger.
inline constexpr std::size_t kChunkBytes = 16U << 20U;
/// Opcode and length in front of every record.
inline constexpr std::size_t kRecordHead = 9;

enum class Op : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

/// Facts of the whole record, kept as the metadata record `ensonify`.
struct RecordInfo {
  std::string version;            // of the software
  std::uint64_t seed = 0;         // of the scenario
  std::int64_t utc_start_ns = 0;  // UTC of sim time 0, ns since 1970
};

/// A file inside the record: the resolved launch, the resolved scenario.
struct Attachment {
  std::string name;
  std::string media_type;
  std::string data;
};

/// Name of the attachment with what the processes of the run declared of themselves (runtime/declared.h).
inline constexpr const char* kDeclarationsName = "declarations.json";

/// Of the facts of a run those that a reader needs to repeat it (launch, scenario, version, seed), and what its
/// processes declared of themselves.
std::vector<Attachment> attachments_of(const std::map<std::string, std::string>& facts);

/// Name of the metadata record of a record that an observer wrote: per topic `TOPIC/received` and `TOPIC/missed`,
/// numbers of messages from the first received on.
inline constexpr const char* kLiveName = "ensonify_live";

/// One topic of the record.
struct Channel {
  std::uint16_t id = 0;  // topic id: order in the launch file
  std::string topic;
  std::string type;           // message type such as "ping/1"
  std::string schema;         // JSON Schema of the type; empty for a type that only foreign programs know
  std::uint32_t rank = 0;     // of the publishing process in the launch file
  std::size_t max_bytes = 0;  // largest message body that the publisher declared; 0 if unknown
};

}  // namespace ensonify::record
