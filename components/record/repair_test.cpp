#include "components/record/repair.h"

#include <sys/file.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <set>

#include "components/record/reader.h"
#include "components/record/testing/test_folder.h"
#include "components/record/writer.h"
#include "messages/codec.h"
#include "messages/sonar.h"

using namespace ensonify;
using namespace ensonify::record;
namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kStart = 1'718'000'000'000'000'000;
constexpr int kPerChunk = 10;  // messages on each of two topics, 0.1 s apart

/// The record of a run of `chunks` seconds.
void write_run(const fs::path& file, int chunks) {
  RecordWriter writer(file, {"1.2.3", 42, kStart}, {{"launch.yaml", "application/yaml", "processes: {}\n"}});
  writer.add_channel({3, "bow/ping", "ping/1", R"({"type":"object"})", 2, 5000});
  writer.add_channel({5, "bow/transmit", "transmit/1", "", 2, 100});
  for (int n = 0; n < chunks * kPerChunk; ++n) {
    msg::Ping ping;
    ping.ping = n;
    writer.write(3, static_cast<std::uint64_t>(n), 100_ms * n, msg::encode_inline(msg::encode(ping)));
    writer.write(5, static_cast<std::uint64_t>(n), 100_ms * n, msg::encode_inline(msg::encode(msg::Transmit{})));
  }
  writer.close();
}

std::string refusal(const fs::path& file) {
  const std::string before = read_file(file);
  try {
    repair(file);
  } catch (const UserError& error) {
    CHECK(read_file(file) == before);
    std::string text = error.what();
    return text.starts_with(file.string() + ": ") ? text.substr(file.string().size() + 2) : text;
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a record cut anywhere becomes the record of its whole chunks") {
  const TestFolder folder;
  std::vector<std::string> of_chunks;  // the writer's own record of a run that long
  for (int chunks = 0; chunks <= 3; ++chunks) {
    write_run(folder / "run.mcap", chunks);
    of_chunks.push_back(read_file(folder / "run.mcap"));
  }
  const std::string& whole = of_chunks.back();
  std::set<std::uint64_t> seen;
  for (std::size_t size = 0; size < whole.size(); size += 11) {
    INFO("cut to " << size << " of " << whole.size());
    write_file(folder / "cut.mcap", whole.substr(0, size));
    Repair repaired;
    try {
      repaired = repair(folder / "cut.mcap");
    } catch (const UserError&) {
      CHECK(size < 250);  // within the header and the facts, before which there is nothing to repair
      continue;
    }
    CHECK_FALSE(repaired.was_whole);
    CHECK(repaired.kept_bytes + repaired.dropped_bytes == size);
    seen.insert(repaired.messages);
    if (repaired.messages > 0) {
      const auto chunks = static_cast<std::size_t>(repaired.messages) / (2 * kPerChunk);
      CHECK(read_file(folder / "cut.mcap") == of_chunks[chunks]);
      CHECK(*repaired.last == 100_ms * static_cast<std::int64_t>(chunks * kPerChunk - 1));
    }
    RecordReader reader(folder / "cut.mcap");
    std::uint64_t messages = 0;
    for (RecordedMessage message; reader.next(message);) ++messages;
    CHECK(messages == repaired.messages);
    CHECK(reader.truncated().empty());
    CHECK(repair(folder / "cut.mcap").was_whole);
  }
  CHECK(seen == std::set<std::uint64_t>{0, 20, 40, 60});
}

TEST_CASE("a whole record is left alone") {
  const TestFolder folder;
  write_run(folder / "run.mcap", 2);
  const std::string before = read_file(folder / "run.mcap");
  CHECK(repair(folder / "run.mcap").was_whole);
  CHECK(read_file(folder / "run.mcap") == before);
}

TEST_CASE("zeros that a lost power supply left behind are dropped") {
  const TestFolder folder;
  write_run(folder / "run.mcap", 2);
  const std::string whole = read_file(folder / "run.mcap");
  const std::size_t data_end = whole.rfind(std::string("\x0F\x04\0\0\0\0\0\0\0", 9));
  write_file(folder / "run.mcap", whole.substr(0, data_end) + std::string(5000, '\0'));
  const Repair repaired = repair(folder / "run.mcap");
  CHECK(repaired.dropped_bytes == 5000);
  CHECK(read_file(folder / "run.mcap") == whole);

  write_run(folder / "short.mcap", 1);
  for (const std::size_t lost : {2000, 300, 100}) {  // within the last chunk, and within its indices
    write_file(folder / "run.mcap", whole.substr(0, data_end - lost) + std::string(lost + 5000, '\0'));
    CHECK(repair(folder / "run.mcap").messages == (lost == 2000 ? 20 : 40));
    CHECK(read_file(folder / "run.mcap") == (lost == 2000 ? read_file(folder / "short.mcap") : whole));
  }
}

TEST_CASE("what is damaged before its end, or is no record of ours, is left alone") {
  const TestFolder folder;
  write_run(folder / "run.mcap", 3);
  const std::string whole = read_file(folder / "run.mcap");
  const std::string chunk_head("\x06", 1);
  const std::size_t data_end = whole.rfind(std::string("\x0F\x04\0\0\0\0\0\0\0", 9));
  const std::size_t transmit = whole.find("bow/transmit");
  const std::string cut = whole.substr(0, data_end);

  std::string damaged = cut;
  damaged[transmit] = 'B';
  write_file(folder / "run.mcap", damaged);
  CHECK_THAT(refusal(folder / "run.mcap"),
             Catch::StartsWith("is damaged at byte ") &&
                 Catch::EndsWith("a chunk's checksum is wrong, and more follows it; nothing was changed"));

  // The first chunk's length, 2^40 too large: cutting there would drop all that is good.
  const std::size_t info = whole.find("launch.yaml");
  const std::size_t chunk = whole.find(chunk_head, whole.find("processes: {}\n", info) + 14 + 4);
  damaged = cut;
  damaged[chunk + 1 + 5] = '\x01';
  write_file(folder / "run.mcap", damaged);
  CHECK_THAT(refusal(folder / "run.mcap"), Catch::Contains("a chunk contradicts its own length"));

  write_file(folder / "text", "a text that is longer than the magic bytes");
  CHECK(refusal(folder / "text") == "is no record: it is not an MCAP file; nothing was changed");
  std::string other = whole;
  other[other.find("x-ensonify/1") + 11] = '9';
  write_file(folder / "other.mcap", other);
  CHECK(refusal(folder / "other.mcap") == "is no record that Ensonify wrote; nothing was changed");
  CHECK_THAT(refusal(folder / "none"), Catch::StartsWith("cannot be written: No such file"));
}

TEST_CASE("a record that is being written is neither repaired nor begun anew") {
  const TestFolder folder;
  RecordWriter writer(folder / "run.mcap", {"1.2.3", 42, kStart});
  CHECK(refusal(folder / "run.mcap") == "another process is writing it");
  CHECK_THROWS_WITH(RecordWriter(folder / "run.mcap", {}), Catch::EndsWith("run.mcap: another process is writing it"));
  writer.close();
  CHECK(repair(folder / "run.mcap").was_whole);
}
