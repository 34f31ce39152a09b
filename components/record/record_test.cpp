#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <random>

#include "components/record/bytes.h"
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

msg::Ping ping(std::int64_t number, std::size_t samples) {
  msg::Ping ping;
  ping.ping = number;
  ping.amplitude_upa = msg::Array<float>({2, samples});
  for (std::size_t i = 0; i < ping.amplitude_upa.size(); ++i) ping.amplitude_upa[i] = static_cast<float>(i);
  return ping;
}

template <class M>
msg::Buffer payload(const M& message) {
  return msg::encode_inline(msg::encode(message));
}

/// 10 pings per second on topic 3 and one transmit event per ping on topic 5.
void write_survey(const fs::path& file, int pings, std::size_t samples = 100) {
  RecordWriter writer(file, {"1.2.3", 42, kStart}, {{"launch.yaml", "application/yaml", "processes: {}\n"}});
  writer.add_channel({3, "bow/ping", "ping/1", R"({"type":"object"})", 2, 5000});
  writer.add_channel({5, "bow/transmit", "transmit/1", "", 2, 100});
  for (int n = 0; n < pings; ++n) {
    const SimTime t = 100_ms * n;
    writer.write(3, static_cast<std::uint64_t>(n), t, payload(ping(n, samples)));
    writer.write(5, static_cast<std::uint64_t>(n), t, payload(msg::Transmit{}));
  }
  writer.close();
}

/// Opcodes of the file's records, in order.
std::string opcodes(const std::string& bytes) {
  std::string ops;
  ByteSource in(std::as_bytes(std::span(bytes)));
  in.raw(8);
  while (in.left() > 8) {
    ops += static_cast<char>(in.u8());
    in.raw(in.u64());
  }
  return ops;
}

struct Outcome {
  int messages = 0;
  bool refused = false;
  std::string truncated;
};

/// Reads and decodes all that can be read.
Outcome read_all(const fs::path& file) {
  Outcome outcome;
  try {
    RecordReader reader(file);
    for (RecordedMessage message; reader.next(message);) {
      ++outcome.messages;
      try {
        msg::decode_inline(message.payload);
      } catch (const msg::DecodeError&) {
      }
    }
    outcome.truncated = reader.truncated();
  } catch (const UserError&) {
    outcome.refused = true;
  }
  return outcome;
}

}  // namespace

TEST_CASE("the checksum gives the published check value, however it is cut") {
  const std::string text = "123456789";
  const auto bytes = std::as_bytes(std::span(text));
  CHECK(crc32(bytes) == 0xCBF43926U);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    CHECK(crc32(bytes.subspan(cut), crc32(bytes.first(cut))) == 0xCBF43926U);
    CHECK(crc32({}, crc32(bytes)) == 0xCBF43926U);
  }
}

TEST_CASE("what was written is read, in order") {
  const TestFolder folder;
  write_survey(folder / "a.mcap", 25);

  RecordReader reader(folder / "a.mcap");
  CHECK(reader.info().version == "1.2.3");
  CHECK(reader.info().seed == 42);
  CHECK(reader.info().utc_start_ns == kStart);
  REQUIRE(reader.attachments().size() == 1);
  CHECK(reader.attachments()[0].name == "launch.yaml");
  CHECK(reader.attachments()[0].data == "processes: {}\n");
  REQUIRE(reader.channels().size() == 2);
  const Channel& bow = reader.channels().at(3);
  CHECK(bow.topic == "bow/ping");
  CHECK(bow.type == "ping/1");
  CHECK(bow.schema == R"({"type":"object"})");
  CHECK(bow.rank == 2);
  CHECK(bow.max_bytes == 5000);
  CHECK(reader.channels().at(5).schema.empty());

  RecordedMessage message;
  for (std::uint32_t n = 0; n < 25; ++n) {
    REQUIRE(reader.next(message));
    CHECK(message.channel->topic == "bow/ping");
    CHECK(message.seq == n);
    CHECK(message.t_sim == 100_ms * n);
    msg::Ping read;
    msg::from_value(msg::decode_inline(message.payload), read, "");
    CHECK(read.ping == n);
    CHECK(read.amplitude_upa == ping(n, 100).amplitude_upa);
    REQUIRE(reader.next(message));
    CHECK(message.channel->topic == "bow/transmit");
  }
  CHECK_FALSE(reader.next(message));
  CHECK(reader.truncated() == "");
}

TEST_CASE("two records of the same messages are equal byte by byte") {
  const TestFolder folder;
  write_survey(folder / "a.mcap", 25);
  write_survey(folder / "deeper/down/b.mcap", 25);
  CHECK(read_file(folder / "a.mcap") == read_file(folder / "deeper/down/b.mcap"));
  write_survey(folder / "c.mcap", 26);
  CHECK(read_file(folder / "a.mcap") != read_file(folder / "c.mcap"));
}

TEST_CASE("records follow the specification's order, one chunk per second of sim time") {
  const TestFolder folder;
  write_survey(folder / "a.mcap", 25);  // 0 .. 2.4 s
  const std::string chunk = "\x06\x07\x07";
  CHECK(opcodes(read_file(folder / "a.mcap")) == "\x01\x0C\x09" + chunk + chunk + chunk +
                                                     "\x0F\x03\x04\x04\x0B\x08\x08\x08\x0A\x0D" +
                                                     std::string(6, '\x0E') + "\x02");
}

TEST_CASE("a long record needs no more memory than a short one") {
  const TestFolder folder;
  RecordWriter writer(folder / "long.mcap", {"1.2.3", 42, kStart});
  writer.add_channel({3, "bow/transmit", "transmit/1", "", 2, 100});
  const msg::Buffer event = payload(msg::Transmit{});
  const auto write_until = [&](int until) {
    while (static_cast<int>(writer.message_count()) < until) {
      writer.write(3, writer.message_count(), 1_s * static_cast<std::int64_t>(writer.message_count()), event);
    }
    const auto memory = ::mallinfo2();
    return memory.uordblks + memory.hblkhd;  // small blocks and large ones
  };
  const auto before = write_until(100);
  const auto after = write_until(20'000);  // as many chunks; an index kept in memory would be 1.7 MB
  CHECK(after < before + 10'000);
  writer.close();

  const std::string ops = opcodes(read_file(folder / "long.mcap"));
  CHECK(std::count(ops.begin(), ops.end(), '\x06') == 20'000);
  CHECK(std::count(ops.begin(), ops.end(), '\x08') == 20'000);
}

TEST_CASE("a chunk ends at 16 MiB") {
  const TestFolder folder;
  write_survey(folder / "a.mcap", 5, 600'000);  // 4.8 MB each, all within a second: three fit
  const std::string ops = opcodes(read_file(folder / "a.mcap"));
  CHECK(std::count(ops.begin(), ops.end(), '\x06') == 2);
  CHECK(read_all(folder / "a.mcap").messages == 10);
}

TEST_CASE("a message larger than a chunk has one of its own") {
  const TestFolder folder;
  write_survey(folder / "a.mcap", 2, 2'500'000);  // 20 MB each
  CHECK(read_all(folder / "a.mcap").messages == 4);
}

TEST_CASE("a record without messages is a record") {
  const TestFolder folder;
  write_survey(folder / "a.mcap", 0);
  RecordReader reader(folder / "a.mcap");
  CHECK(reader.channels().size() == 2);
  RecordedMessage message;
  CHECK_FALSE(reader.next(message));
  CHECK(reader.truncated().empty());
}

TEST_CASE("a record cut anywhere is read to its last whole chunk, and says so") {
  const TestFolder folder;
  write_survey(folder / "whole.mcap", 25, 10);
  const std::string whole = read_file(folder / "whole.mcap");
  const std::size_t data_end = whole.rfind(std::string("\x0F\x04\0\0\0\0\0\0\0", 9));
  REQUIRE(data_end != std::string::npos);
  int last = 0;
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    INFO("cut to " << size << " of " << whole.size());
    write_file(folder / "cut.mcap", whole.substr(0, size));
    const Outcome outcome = read_all(folder / "cut.mcap");
    CHECK(outcome.messages >= last);
    CHECK((outcome.messages == 0 || outcome.messages == 20 || outcome.messages == 40 || outcome.messages == 50));
    if (!outcome.refused && size <= data_end) CHECK_FALSE(outcome.truncated.empty());
    last = outcome.messages;
  }
  CHECK(last == 50);
}

TEST_CASE("damaged records never crash, and damaged messages are not passed on") {
  const TestFolder folder;
  write_survey(folder / "whole.mcap", 12, 10);
  const std::string whole = read_file(folder / "whole.mcap");
  std::mt19937 random(1);
  int noticed = 0;
  for (int round = 0; round < 2000; ++round) {
    std::string damaged = whole;
    const int flips = 1 + static_cast<int>(random() % 4);
    for (int i = 0; i < flips; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
    if (random() % 4 == 0) damaged.resize(random() % damaged.size());
    write_file(folder / "damaged.mcap", damaged);
    const Outcome outcome = read_all(folder / "damaged.mcap");
    CHECK(outcome.messages <= 24);
    noticed += outcome.refused || !outcome.truncated.empty() ? 1 : 0;
  }
  CHECK(noticed > 1000);  // most of the bytes are covered by a checksum
}

TEST_CASE("what is no record is refused with its name and the reason") {
  const TestFolder folder;
  const auto refusal = [](const fs::path& file) {
    try {
      RecordReader reader(file);
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  write_file(folder / "empty", "");
  write_file(folder / "text", "a text that is longer than the magic bytes");
  write_survey(folder / "other.mcap", 1);
  std::string other = read_file(folder / "other.mcap");
  other[other.find("x-ensonify/1") + 11] = '9';
  write_file(folder / "other.mcap", other);

  CHECK(refusal(folder / "none") == (folder / "none").string() + ": cannot be read: No such file or directory");
  CHECK(refusal(folder / "empty") == (folder / "empty").string() + ": is no record: it ends within a record");
  CHECK(refusal(folder / "text") == (folder / "text").string() + ": is no record: it is not an MCAP file");
  CHECK(refusal(folder / "other.mcap") == (folder / "other.mcap").string() +
                                              ": is no record: its format is \"x-ensonify/9\", this program reads "
                                              "\"x-ensonify/1\"");
  CHECK(refusal(folder.path) != "accepted");
}

TEST_CASE("a file that cannot be created is named with the cause") {
  const TestFolder folder;
  write_file(folder / "file", "");
  const auto problem = [](const fs::path& file) {
    try {
      RecordWriter writer(file, {});
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  CHECK(problem(folder / "file/a.mcap") ==
        (folder / "file/a.mcap").string() + ": cannot make its folder: Not a directory");
  const fs::path long_name = folder / std::string(300, 'x');
  CHECK(problem(long_name) == long_name.string() + ": cannot be written: File name too long");
  const fs::path long_path = folder / (std::string(150, 'a') + "/" + std::string(150, 'b') + "/a.mcap");
  CHECK(problem(long_path) == "none");  // 300 characters are no problem in themselves
  CHECK(fs::exists(long_path));
}

TEST_CASE("a full disk is data lost, and what is there can be read") {
  CHECK_THROWS_AS(RecordWriter("/dev/full", {}), DataLost);

  const TestFolder folder;
  struct rlimit before {};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit small { 115'000, before.rlim_max };
  ::setrlimit(RLIMIT_FSIZE, &small);  // stands for a disk of 115 kB
  std::string error;
  try {
    write_survey(folder / "full.mcap", 100, 500);  // 4 kB each: two chunks fit
  } catch (const DataLost& lost) {
    error = lost.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);

  CHECK_THAT(error, Catch::StartsWith((folder / "full.mcap").string() + ": cannot be written further: File too large"));
  CHECK_THAT(error, Catch::EndsWith("to the last whole chunk, with its index"));
  const Outcome outcome = read_all(folder / "full.mcap");
  CHECK(outcome.messages == 40);
  CHECK(outcome.truncated.empty());
}
