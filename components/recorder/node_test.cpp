#include "components/recorder/node.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "components/errors/exit_error.h"
#include "components/record/reader.h"
#include "components/runtime/testing/node_under_test.h"
#include "messages/schema.h"
#include "messages/sonar.h"

using namespace ensonify;
namespace fs = std::filesystem;

namespace {

/// A folder of this test program, gone at its end.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("ensonify_recorder_test_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

msg::Transmit transmit(std::int64_t number) {
  msg::Transmit message;
  message.stamp_ns = number * 10'000'000;
  message.ping = number;
  return message;
}

struct Kept {
  std::string topic;
  SimTime t;
  std::uint32_t seq;
};

std::vector<Kept> read(const fs::path& file) {
  record::RecordReader reader(file);
  std::vector<Kept> kept;
  for (record::RecordedMessage m; reader.next(m);) kept.push_back({m.channel->topic, m.t_sim, m.seq});
  CHECK(reader.truncated().empty());
  return kept;
}

RecorderConfig everything() {
  RecorderConfig config;
  config.seed = 7;
  config.start_unix_ns = 1'748'736'000'000'000'000;
  return config;
}

}  // namespace

TEST_CASE("a recorder keeps what was published up to its event, in the one order") {
  const Folder folder;
  NodeUnderTest<RecorderNode> recorder(everything(), "recorder", folder.path);
  recorder.connect_any("topics", "bow/transmit", "transmit/1");
  recorder.connect_any("topics", "aft/transmit", "transmit/1");
  for (int n = 0; n < 20; ++n) recorder.give("aft/transmit", transmit(n));  // arrives first, ranks second
  for (int n = 0; n < 20; ++n) recorder.give("bow/transmit", transmit(n));
  recorder.run_until(100_ms);
  CHECK(recorder.next() == 200_ms);
  recorder.node().finish_run();

  const auto kept = read(folder.path / "record.mcap");
  REQUIRE(kept.size() == 22);  // 0 .. 100 ms; later ones were not due
  for (std::uint32_t i = 0; i < kept.size(); ++i) {
    CHECK(kept[i].topic == (i % 2 == 0 ? "bow/transmit" : "aft/transmit"));
    CHECK(kept[i].t == 10_ms * (i / 2));
    CHECK(kept[i].seq == i / 2);
  }
}

TEST_CASE("the record knows seed, start and schema") {
  const Folder folder;
  NodeUnderTest<RecorderNode> recorder(everything(), "recorder", folder.path);
  recorder.connect_any("topics", "bow/transmit", "transmit/1");
  recorder.connect_any("topics", "agent/thought", "thought/1");
  recorder.run_until(0_s);
  recorder.node().finish_run();

  record::RecordReader reader(folder.path / "record.mcap");
  CHECK(reader.info().seed == 7);
  CHECK(reader.info().utc_start_ns == 1'748'736'000'000'000'000);
  REQUIRE(reader.channels().size() == 2);
  CHECK(reader.channels().begin()->second.schema == msg::json_schema(msg::find_type("transmit/1")));
  CHECK(reader.channels().rbegin()->second.schema.empty());  // a type that only a foreign program knows
}

TEST_CASE("every: N keeps each N-th message of a topic, counted by its sequence number") {
  const Folder folder;
  RecorderConfig config = everything();
  config.file = "deeper/thin.mcap";
  config.topics = {{"*", 1}, {"bow/transmit", 7}};
  NodeUnderTest<RecorderNode> recorder(config, "recorder", folder.path);
  recorder.connect_any("topics", "bow/transmit", "transmit/1");
  for (int n = 0; n < 30; ++n) recorder.give("bow/transmit", transmit(n));
  recorder.run_until(1_s);
  recorder.node().finish_run();

  const auto kept = read(folder.path / "deeper/thin.mcap");
  REQUIRE(kept.size() == 5);
  for (std::uint32_t i = 0; i < 5; ++i) CHECK(kept[i].seq == 7 * i);
}

TEST_CASE("a file that cannot be written is the user's mistake, named with its place") {
  const Folder folder;
  std::ofstream(folder.path / "file") << "no folder";
  RecorderConfig config = everything();
  config.file = "file/a.mcap";
  config.file_place = "demo.yaml:12:5";
  NodeUnderTest<RecorderNode> recorder(config, "recorder", folder.path);
  recorder.connect_any("topics", "bow/transmit", "transmit/1");
  CHECK_THROWS_AS(recorder.run_until(0_s), UserError);
  CHECK_THROWS_WITH(recorder.run_until(0_s), "demo.yaml:12:5: file: " + (folder.path / "file/a.mcap").string() +
                                                 ": cannot make its folder: Not a directory");
}
