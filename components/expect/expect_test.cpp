#include <unistd.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "components/config/config_reader.h"
#include "components/errors/exit_error.h"
#include "components/expect/node.h"
#include "components/record/writer.h"
#include "components/runtime/testing/node_under_test.h"
#include "messages/motion.h"
#include "messages/soundings.h"

using namespace ensonify;
namespace fs = std::filesystem;

namespace {

ExpectConfig config_of(const std::string& list) {
  auto from = ConfigReader::from_text("expect:\n" + list, "run.yaml");
  const auto config = ExpectConfig::read(from);
  from.finish();
  return config;
}

std::string problem(const std::string& list) {
  try {
    config_of(list);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("expect_test_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

msg::MissionState mission(SimTime t, const std::string& state) {
  msg::MissionState m;
  m.stamp_ns = t.count();
  m.state = state;
  return m;
}

msg::Soundings soundings(SimTime t, std::vector<std::uint8_t> valid, std::vector<float> quality) {
  msg::Soundings s;
  s.stamp_ns = t.count();
  s.valid = msg::Array<std::uint8_t>::of(std::move(valid));
  s.quality_db = msg::Array<float>::of(std::move(quality));
  s.position_enu_m = msg::Array<double>({2, 3});
  std::ranges::copy(std::array{100.0, 200.0, -15.0, 101.0, 201.0, -16.0}, s.position_enu_m.flat().begin());
  return s;
}

/// What becomes of one expectation in a run of 10 s: the mission turns, is on its line from 2 s and done at 8 s; every
/// second there are soundings whose quality is the time in seconds, three of four beams valid, one quality NaN.
expect::Verdict verdict_of(const std::string& entry, int& exit_code) {
  const Folder out;
  NodeUnderTest<ExpectNode> node(config_of("- " + entry + "\n"), "expect", out.path());
  const auto wants = [&](const std::string& topic) {
    const auto& topics = node.ports().ins().at(0).topics;
    return std::find(topics.begin(), topics.end(), topic) != topics.end();
  };
  if (wants("pilot/mission")) node.connect_any("topics", "pilot/mission", msg::MissionState::kType);
  if (wants("bow/soundings")) node.connect_any("topics", "bow/soundings", msg::Soundings::kType);
  if (wants("auv/pose")) node.connect_any("topics", "auv/pose", msg::Pose::kType);  // silent
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int t = 0; t <= 9; ++t) {
    const SimTime at = SimTime{1_s} * t;
    const auto quality = static_cast<float>(t);
    if (wants("pilot/mission")) node.give("pilot/mission", mission(at, t < 2 ? "turn" : t < 8 ? "on_line" : "done"));
    if (wants("bow/soundings")) node.give("bow/soundings", soundings(at, {1, 1, 0, 1}, {quality, nan}));
  }
  node.run_until(10_s);
  node.node().finish_run();
  exit_code = node.node().exit_code();
  std::ifstream file(out.path() / "expect.json");
  const auto results = nlohmann::json::parse(file);
  REQUIRE(results.size() == 1);
  CHECK_FALSE(results[0].at("name").get<std::string>().empty());
  return {results[0].at("ok"), from_seconds(results[0].at("t_s")), results[0].at("message")};
}

void check_passes(const std::string& entry, const std::string& message) {
  int exit_code = -1;
  const auto verdict = verdict_of(entry, exit_code);
  INFO(entry);
  CHECK(verdict.message == message);
  CHECK(verdict.ok);
  CHECK(exit_code == 0);
}

void check_fails(const std::string& entry, double t_s, const std::string& message) {
  int exit_code = -1;
  const auto verdict = verdict_of(entry, exit_code);
  INFO(entry);
  CHECK(verdict.message == message);
  CHECK_FALSE(verdict.ok);
  CHECK(seconds(verdict.t) == Approx(t_s));
  CHECK(exit_code == 1);
}

}  // namespace

TEST_CASE("count") {
  check_passes("count: {topic: bow/soundings, min: 10, max: 10}", "10 messages");
  check_fails("count: {topic: bow/soundings, min: 11}", 10, "10 messages came; at least 11 were expected");
  check_fails("count: {topic: bow/soundings, max: 4}", 4, "message 5 came; at most 4 were expected");
  check_passes("count: {topic: pilot/mission, where: {field: state, equals: on_line}, min: 6, max: 6}", "6 messages");
  check_passes("count: {topic: auv/pose, max: 0}", "0 messages");
  check_fails("count: {topic: auv/pose, where: {field: stamp_ns, above: 5}, max: 0}", 10,
              "there was no message on auv/pose");
}

TEST_CASE("rate counts silence at the end") {
  check_passes("rate: {topic: bow/soundings, hz: 1}", "1 Hz");
  check_fails("rate: {topic: bow/soundings, hz: 2, tolerance: 0.1}", 10,
              "10 messages in 10.000 s are 1 Hz; 2 Hz within 10 % were expected");
  check_fails("rate: {topic: auv/pose, hz: 2}", 10, "there was no message on auv/pose");
  check_fails("rate: {topic: bow/soundings, hz: 0.01}", 10, "10 s are too short for a rate of 0.01 Hz");
}

TEST_CASE("bounds on fields, array elements and reductions") {
  check_passes("bounds: {topic: bow/soundings, field: valid.mean, min: 0.75, max: 0.75}", "10 values in [0.75, 0.75]");
  check_passes("bounds: {topic: bow/soundings, field: quality_db.max, max: 9}", "10 values in [0, 9]");
  check_fails("bounds: {topic: bow/soundings, field: quality_db.0, max: 6.5}", 7, "quality_db.0 = 7 (message 7)");
  check_fails("bounds: {topic: bow/soundings, field: quality_db.1, min: 0}", 0, "quality_db.1 = nan (message 0)");
  check_fails("bounds: {topic: bow/soundings, field: quality_db.5, min: 0}", 10,
              "quality_db.5 had no value in 10 messages");
  check_passes("bounds: {topic: bow/soundings, field: quality_db.0, min: 3, after_s: 3}", "7 values in [3, 9]");
  check_fails("bounds: {topic: bow/soundings, field: quality_db.0, min: 0, after_s: 30}", 10,
              "there was no message on bow/soundings");
  check_passes("bounds: {topic: bow/soundings, where: {field: ping, equals: 0}, field: valid.all, max: 0}",
               "10 values in [0, 0]");
  check_passes("bounds: {topic: bow/soundings, field: position_enu_m.2.min, min: -16, max: -16}",
               "10 values in [-16, -16]");
  check_passes("bounds: {topic: bow/soundings, field: position_enu_m.0.max, max: 101}", "10 values in [101, 101]");
  check_fails("bounds: {topic: bow/soundings, field: position_enu_m.3.max, max: 0}", 10,
              "position_enu_m.3.max had no value in 10 messages");
  check_fails("bounds: {topic: bow/soundings, field: quality_db.0.max, max: 0}", 10,
              "quality_db.0.max had no value in 10 messages");
  check_fails("bounds: {topic: auv/pose, field: position_enu_m.2, max: 0}", 10, "there was no message on auv/pose");
}

TEST_CASE("eventually and never") {
  check_passes("eventually: {topic: pilot/mission, where: {field: state, equals: done}, within_s: 8}",
               "first at 8.000 s");
  check_fails("eventually: {topic: pilot/mission, where: {field: state, equals: done}, within_s: 7}", 7,
              "came only at 8.000 s");
  check_fails("eventually: {topic: pilot/mission, where: {field: state, equals: lost}, within_s: 7}", 7, "never came");
  check_passes("never: {topic: pilot/mission, where: {field: state, equals: lost}}", "never came");
  check_fails("never: {topic: pilot/mission, where: {field: state, equals: on_line}}", 2,
              "came at 2.000 s (message 2)");
  check_passes("never: {topic: pilot/mission, where: {field: state, equals: turn}, after_s: 2}", "never came");
  check_fails("never: {topic: auv/pose, where: {field: stamp_ns, above: 0}}", 10, "there was no message on auv/pose");
  check_fails("never: {topic: bow/soundings, where: {field: backscatter_db.max, above: 0}}", 10,
              "backscatter_db.max had no value in 10 messages on bow/soundings");
}

TEST_CASE("order and gaps") {
  const std::string on_line = "{topic: pilot/mission, where: {field: state, equals: on_line}}";
  const std::string done = "{topic: pilot/mission, where: {field: state, equals: done}}";
  check_passes("order: {first: " + on_line + ", then: " + done + "}",
               "pilot/mission with state = on_line at 2.000 s, pilot/mission with state = done at 8.000 s");
  check_fails("order: {first: " + done + ", then: " + on_line + "}", 2,
              "pilot/mission with state = done at 8.000 s, pilot/mission with state = on_line at 2.000 s");
  check_fails("order: {first: {topic: auv/pose}, then: " + done + "}", 10, "there was no message on auv/pose");
  check_passes("no_gap: {topic: bow/soundings}", "10 messages");
  check_fails("no_gap: {topic: auv/pose}", 10, "there was no message on auv/pose");
}

TEST_CASE("a gap is seen by the number that is missing") {
  const auto check = expect::make_check(config_of("- no_gap: {topic: a/b}\n").expectations[0]);
  for (const std::uint64_t seq : {0, 1, 3}) {
    msg::Packet packet;
    packet.topic = "a/b";
    packet.envelope.seq = seq;
    packet.envelope.t_sim_ns = static_cast<std::int64_t>(seq) * 1'000'000'000;
    check->see(expect::Observation(packet));
  }
  const auto verdict = check->close(9_s);
  CHECK_FALSE(verdict.ok);
  CHECK(verdict.t == 3_s);
  CHECK(verdict.message == "message 3 came where 2 was due");
}

TEST_CASE("same_as compares time, number and bytes with a record") {
  const Folder folder;
  const auto write = [&](const std::string& name, int count, double third_east_m) {
    record::RecordWriter writer(folder.path() / name, record::RecordInfo{}, {});
    record::Channel channel;
    channel.topic = "auv/pose";
    channel.type = msg::Pose::kType;
    writer.add_channel(channel);
    for (int i = 0; i < count; ++i) {
      msg::Pose pose;
      pose.stamp_ns = (i * SimTime{1_s}).count();
      if (i == 2) pose.position_enu_m[0] = third_east_m;
      writer.write(0, static_cast<std::uint64_t>(i), i * SimTime{1_s}, msg::encode_inline(msg::encode(pose)));
    }
    writer.close();
  };
  write("same.mcap", 4, 0.0);
  write("other.mcap", 4, 0.5);
  write("longer.mcap", 5, 0.0);
  write("shorter.mcap", 3, 0.0);
  const auto run = [&](const std::string& record, int& exit_code) {
    NodeUnderTest<ExpectNode> node(config_of("- same_as: {record: " + (folder.path() / record).string() + "}\n"),
                                   "expect", folder.path());
    node.connect_any("topics", "auv/pose", msg::Pose::kType);
    for (int i = 0; i < 4; ++i) {
      msg::Pose pose;
      pose.stamp_ns = (i * SimTime{1_s}).count();
      node.give("auv/pose", pose);
    }
    node.run_until(6_s);
    node.node().finish_run();
    exit_code = node.node().exit_code();
    std::ifstream file(folder.path() / "expect.json");
    return nlohmann::json::parse(file).at(0).at("message").get<std::string>();
  };
  int exit_code = -1;
  CHECK(run("same.mcap", exit_code) == "4 messages are equal");
  CHECK(exit_code == 0);
  CHECK(run("other.mcap", exit_code) ==
        "auv/pose 2 at 2.000 s differs: position_enu_m is [0,0,0], in the record [0.5,0,0]");
  CHECK(exit_code == 6);
  CHECK(run("longer.mcap", exit_code) == "auv/pose 4 of the record at 4.000 s did not come");
  CHECK(exit_code == 6);
  CHECK(run("shorter.mcap", exit_code) == "auv/pose 3 at 3.000 s is not in the record");
  CHECK(exit_code == 6);
}

TEST_CASE("a misspelt field is reported when the wiring is known, with its place") {
  NodeUnderTest<ExpectNode> node(
      config_of("- bounds: {topic: auv/pose, field: positon_enu_m.2, max: 0}\n"
                "- never: {topic: auv/pose, where: {field: position_enu_m.3, above: 0}}\n"
                "- never: {topic: auv/pose, where: {field: velocity_enu_mps, above: 0}}\n"));
  node.connect_any("topics", "auv/pose", msg::Pose::kType);
  CHECK_THROWS_WITH(
      node.run_until(0_s),
      "run.yaml:2:36: positon_enu_m.2: there is no field positon_enu_m; did you mean position_enu_m? (pose/1)\n"
      "run.yaml:3:43: position_enu_m.3: there is no element 3; allowed: 0..2 (pose/1)\n"
      "run.yaml:4:43: velocity_enu_mps: is not a single value; add an index or one of min, max, mean, any, all, "
      "nonzero, size (pose/1)");
}

TEST_CASE("mistakes in the list are reported with their places") {
  CHECK(problem("- cuont: {topic: a/b}\n") ==
        "run.yaml:2:3: expect[0]: says nothing; give one of count, rate, bounds, eventually, never, order, no_gap, "
        "same_as, exit\n"
        "run.yaml:2:3: expect[0].cuont: is not a known key; did you mean count?");
  CHECK(problem("- count: {topic: a/b}\n") == "run.yaml:2:10: expect[0].count: has no limit; give min, max or both");
  CHECK(problem("- count: {topic: a/b, min: 3, max: 2}\n") == "run.yaml:2:36: expect[0].count.max: is below min");
  CHECK(problem("- never: {topic: a/b, where: {field: x}}\n").find("compares nothing") != std::string::npos);
  CHECK(problem("- never: {topic: a/b}\n").find("where: is missing") != std::string::npos);
  CHECK(problem("- rate: {topic: a/b, hz: 0}\n").find("0 is outside") != std::string::npos);
  CHECK(problem("- same_as: {record: nowhere.mcap}\n").find("nowhere.mcap") != std::string::npos);
  CHECK(problem("- {count: {topic: a/b, min: 1}, no_gap: {topic: a/b}}\n").find("says several things") !=
        std::string::npos);
}

TEST_CASE("an expectation is called what its user names it, or what it says") {
  const auto config =
      config_of("- {count: {topic: a/b, min: 1}, name: enough}\n- rate: {topic: nav/attitude, hz: 100}\n");
  CHECK(config.expectations[0].name == "enough");
  CHECK(config.expectations[1].name == "rate of nav/attitude 100 Hz");
}

TEST_CASE("equal expectations keep different names") {
  const auto config = config_of("- no_gap: {topic: a/b}\n- no_gap: {topic: a/b}\n");
  CHECK(config.expectations[0].name == "no gap in a/b");
  CHECK(config.expectations[1].name == "no gap in a/b (2)");
}

TEST_CASE("a list's element is found by its name, and text compares as text") {
  msg::Health health;
  health.counters = {{"pings", 7}, {"late", 2}};
  const auto value = msg::to_value(health);
  CHECK(std::get<double>(*expect::value_at(value, "counters.late.count")) == 2.0);
  CHECK(std::get<double>(*expect::value_at(value, "counters.size")) == 2.0);
  CHECK_FALSE(expect::value_at(value, "counters.early.count").has_value());
  CHECK(expect::path_fault(*msg::find_type("health/1"), "counters.late.count") == "");
  CHECK(expect::path_fault(*msg::find_type("health/1"), "counters.late.cuont").find("did you mean count?") !=
        std::string::npos);
  expect::Condition is_ok{{"state", {}}, "ok", {}, {}, {}, {}, {}};
  CHECK(is_ok.holds(*expect::value_at(value, "state")));
  expect::Condition above{{"state", {}}, {}, {}, 1.0, {}, {}, {}};
  CHECK_FALSE(above.holds(*expect::value_at(value, "state")));
}
