#include "components/replay/node.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "components/config/config_reader.h"
#include "components/errors/exit_error.h"
#include "components/record/writer.h"
#include "components/runtime/testing/node_under_test.h"
#include "messages/motion.h"
#include "messages/schema.h"
#include "messages/sonar.h"

using namespace ensonify;
namespace fs = std::filesystem;

namespace {

/// A record of 3 s: a ping every 500 ms, of which every second was kept, and a command every second.
struct Recorded {
  fs::path folder = fs::temp_directory_path() / ("ensonify_replay_test_" + std::to_string(::getpid()));
  fs::path file = folder / "a.mcap";

  Recorded() {
    record::RecordWriter writer(file, {"1", 1, 1'000});
    writer.add_channel({4, "bow/ping", "ping/1", "", 1, 5000});
    writer.add_channel({6, "agent/command", "guidance/1", "", 2, 0});
    writer.add_channel({7, "bow/health", "health/1", "", 1, 100});
    for (int n = 0; n < 6; ++n) {
      msg::Ping ping;
      ping.ping = n;
      ping.amplitude_upa = msg::Array<float>({2, 5});
      if (n % 2 == 0) writer.write(4, static_cast<std::uint64_t>(n), 500_ms * n, msg::encode_inline(msg::encode(ping)));
      if (n % 2 == 1) writer.write(6, 0, 500_ms * n, msg::encode_inline(msg::encode(msg::Guidance{})));
    }
    writer.close();
  }
  ~Recorded() { fs::remove_all(folder); }

  ReplayConfig config() const {
    ReplayConfig config;
    config.file = file;
    return config;
  }
};

}  // namespace

TEST_CASE("a replay publishes each message at its time, none skipped, numbered anew") {
  const Recorded recorded;
  NodeUnderTest<ReplayNode> replay(recorded.config());
  replay.run_until(10_s);
  const auto pings = replay.take("bow/ping");
  REQUIRE(pings.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(SimTime{pings[i].envelope.t_sim_ns} == 1_s * i);
    CHECK(pings[i].envelope.seq == i);
    const auto ping = msg::decode<msg::Ping>(pings[i].body, pings[i].body.size());
    CHECK(ping.ping == static_cast<std::int64_t>(2 * i));
    CHECK(ping.amplitude_upa.shape() == std::vector<std::size_t>{2, 5});
  }
  CHECK(replay.take("agent/command").size() == 3);
  CHECK(replay.next() == kNever);
  CHECK_FALSE(replay.finished());
}

TEST_CASE("ports are as wide and as fast as the record needs") {
  const Recorded recorded;
  NodeUnderTest<ReplayNode> replay(recorded.config());
  const auto& outs = replay.ports().outs();
  REQUIRE(outs.size() == 4);
  CHECK(outs[0].port == "bow/ping");
  CHECK(outs[0].type == "ping/1");
  CHECK(outs[0].max_bytes == 5000);
  CHECK(outs[1].max_bytes >= msg::encode(msg::Guidance{}).size());
  CHECK(outs[1].rate == Rate{1, 1});
  CHECK(outs[2].port == "bow/health");
}

TEST_CASE("a replay named like a recorded process takes its place") {
  const Recorded recorded;
  ReplayConfig config = recorded.config();
  config.topics = {"bow/*", "agent/command"};
  config.rename = {{"agent/command", "order"}};
  NodeUnderTest<ReplayNode> bow(config, "bow");
  const auto& outs = bow.ports().outs();
  REQUIRE(outs.size() == 3);
  CHECK(outs[0].port == "ping");
  CHECK(outs[1].port == "order");
  CHECK(outs[2].port == "health");  // its own
}

TEST_CASE("finish ends the run after the last message") {
  const Recorded recorded;
  ReplayConfig config = recorded.config();
  config.finish = true;
  NodeUnderTest<ReplayNode> replay(config);
  replay.run_until(2400_ms);
  CHECK_FALSE(replay.finished());
  replay.run_until(2500_ms);
  CHECK(replay.finished());
}

TEST_CASE("a record that ends early is played as far as it goes, and health says so") {
  const Recorded recorded;
  fs::resize_file(recorded.file, fs::file_size(recorded.file) / 2);
  NodeUnderTest<ReplayNode> replay(recorded.config());
  const auto health = replay.step_until<msg::Health>("health", 10_s);
  REQUIRE(health.size() == 1);
  CHECK(health[0].state == "degraded");
  CHECK_THAT(health[0].message, Catch::StartsWith("the record ends early at byte "));
}

TEST_CASE("a topic that the record lacks is named with its place and the nearest") {
  const Recorded recorded;
  ReplayConfig config = recorded.config();
  config.topics = {"bow/pimg"};
  config.topics_place = "a.yaml:3:9";
  CHECK_THROWS_WITH(NodeUnderTest<ReplayNode>(config),
                    "a.yaml:3:9: the record " + recorded.file.string() + " holds no bow/pimg (did you mean bow/ping?)");
  CHECK_THROWS_AS(NodeUnderTest<ReplayNode>(config), UserError);
}

TEST_CASE("replay parameters are read with their places, and its defaults are written down") {
  const Recorded recorded;
  auto from = ConfigReader::from_text(
      "file: " + recorded.file.string() + "\ntopics: [bow/ping]\nrename: {bow/ping: echo}\nfinish: true", "r.yaml");
  const ReplayConfig config = ReplayConfig::read(from);
  from.finish();
  CHECK(config.topics == std::vector<std::string>{"bow/ping"});
  CHECK(config.rename.at("bow/ping") == "echo");
  CHECK(config.finish);
  CHECK(config.file_place == "r.yaml:1:7");

  const auto problem = [&](const std::string& yaml) {
    auto wrong = ConfigReader::from_text("file: " + recorded.file.string() + "\n" + yaml, "r.yaml");
    ReplayConfig::read(wrong);
    try {
      wrong.finish();
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(problem("topics: []") == "r.yaml:2:9: topics: names no topic");
  CHECK(problem("topics: some") == "r.yaml:2:9: topics: \"some\" is not all or a list of topics");
  CHECK(problem("topics: all\nrename: {}\nfinish: false").empty());
}
