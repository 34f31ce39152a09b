#include "components/record/compare.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "components/record/value_difference.h"
#include "components/record/writer.h"
#include "messages/codec.h"
#include "messages/health.h"
#include "messages/motion.h"
#include "messages/sonar.h"

using namespace ensonify;
using namespace ensonify::record;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("ensonify_compare_test_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

/// One message of the run below, before it is written.
struct Message {
  std::uint16_t channel;
  std::uint64_t seq;
  SimTime t;
  bool lost = false;
  msg::Pose pose;
  msg::Ping ping;
};

/// 10 poses and 2 pings a second for 5 s, with one change.
void write_run(const fs::path& file, const std::function<void(Message&)>& change = {}, const char* seed = "1") {
  RecordWriter writer(file, {"1", 1, 1'000'000'000}, {{"seed", "text/plain", seed}});
  writer.add_channel({1, "auv/pose", "pose/1", "", 1, 1000});
  writer.add_channel({2, "bow/ping", "ping/1", "", 2, 1000});
  const auto put = [&](Message message) {
    if (change) change(message);
    if (message.lost) return;
    const msg::Body body = message.channel == 1 ? msg::encode(message.pose) : msg::encode(message.ping);
    writer.write(message.channel, message.seq, message.t, msg::encode_inline(body));
  };
  for (int n = 0; n < 50; ++n) {
    Message pose{1, static_cast<std::uint64_t>(n), 100_ms * n, false, {}, {}};
    pose.pose.position_enu_m = {1.0 * n, 0.1, -3.0};
    put(pose);
    if (n % 5 != 0) continue;
    Message ping{2, static_cast<std::uint64_t>(n / 5), 100_ms * n, false, {}, {}};
    ping.ping.amplitude_upa = msg::Array<float>({4, 10});
    for (float& sample : ping.ping.amplitude_upa.flat()) sample = 0.5F;
    put(ping);
  }
  writer.close();
}

Comparison compare_with(const std::function<void(Message&)>& change, const std::vector<std::string>& topics = {}) {
  const Folder folder;
  write_run(folder.path / "a.mcap");
  write_run(folder.path / "b.mcap", change);
  RecordReader a(folder.path / "a.mcap");
  RecordReader b(folder.path / "b.mcap");
  return compare(a, b, topics);
}

}  // namespace

TEST_CASE("equal records have no difference, and every message is counted") {
  const Comparison same = compare_with({});
  CHECK_FALSE(same.first);
  CHECK(same.notes.empty());
  REQUIRE(same.topics.size() == 2);
  CHECK(same.topics[0].topic == "auv/pose");
  CHECK(same.topics[0].a == 50);
  CHECK(same.topics[0].b == 50);
  CHECK(same.topics[1].a == 10);
  CHECK(same.topics[1].only_a + same.topics[1].only_b + same.topics[1].differing == 0);
}

TEST_CASE("one planted bit in one sample is found and named") {
  const Comparison differ = compare_with([](Message& m) {
    if (m.channel == 2 && m.seq == 7) m.ping.amplitude_upa(3, 8) = std::nextafter(0.5F, 1.0F);
  });
  REQUIRE(differ.first);
  CHECK(differ.first->t_sim == 3500_ms);
  CHECK(differ.first->topic == "bow/ping");
  CHECK(differ.first->seq == 7);
  CHECK(differ.first->field == "amplitude_upa[3,8]");
  CHECK(differ.first->a == "0.5");
  CHECK(differ.first->b == "0.50000006");
  CHECK(differ.topics[1].differing == 1);
}

TEST_CASE("a time shift is found, even when the content is the same") {
  const Comparison differ = compare_with([](Message& m) {
    if (m.channel == 1 && m.seq == 20) m.t += SimTime{1};
  });
  REQUIRE(differ.first);
  CHECK(differ.first->topic == "auv/pose");
  CHECK(differ.first->seq == 20);
  CHECK(differ.first->field == "t_sim_ns");
  CHECK(differ.first->a == "2000000000");
  CHECK(differ.first->b == "2000000001");
}

TEST_CASE("a lost message is found, on either side, also the last one") {
  for (const std::uint64_t seq : {std::uint64_t{4}, std::uint64_t{9}}) {
    const auto lose = [seq](Message& m) { m.lost = m.channel == 2 && m.seq == seq; };
    const Comparison lost = compare_with(lose);
    REQUIRE(lost.first);
    CHECK(lost.first->t_sim == 500_ms * seq);
    CHECK(lost.first->topic == "bow/ping");
    CHECK(lost.first->seq == seq);
    CHECK(lost.first->a == "there");
    CHECK(lost.first->b == "missing");
    CHECK(lost.topics[1].b == 9);
    CHECK(lost.topics[1].only_a == 1);
    CHECK(lost.topics[1].differing == 0);

    const Folder folder;
    write_run(folder.path / "a.mcap", lose);
    write_run(folder.path / "b.mcap");
    RecordReader a(folder.path / "a.mcap");
    RecordReader b(folder.path / "b.mcap");
    const Comparison added = compare(a, b);
    REQUIRE(added.first);
    CHECK(added.first->a == "missing");
    CHECK(added.topics[1].only_b == 1);
  }
}

TEST_CASE("of several differences the earliest in sim time is named, however late found") {
  const Comparison differ = compare_with([](Message& m) {
    if (m.channel == 2 && m.seq == 3) m.lost = true;                        // 1.5 s, noticed at 2.0 s
    if (m.channel == 1 && m.seq >= 17) m.pose.position_enu_m[2] = -2.9999;  // 1.7 s
  });
  REQUIRE(differ.first);
  CHECK(differ.first->topic == "bow/ping");
  CHECK(differ.first->seq == 3);
  CHECK(differ.topics[0].differing == 33);
}

TEST_CASE("topics can be chosen") {
  const auto change = [](Message& m) { m.lost = m.channel == 2; };
  CHECK(compare_with(change).topics[1].only_a == 10);
  CHECK_FALSE(compare_with(change, {"auv/*"}).first);
  CHECK(compare_with(change, {"auv/*"}).topics.size() == 1);
}

TEST_CASE("what differs beside the messages is noted") {
  const Folder folder;
  write_run(folder.path / "a.mcap");
  write_run(folder.path / "b.mcap", {}, "2");
  RecordReader a(folder.path / "a.mcap");
  RecordReader b(folder.path / "b.mcap");
  const Comparison comparison = compare(a, b);
  CHECK_FALSE(comparison.first);
  CHECK(comparison.notes == std::vector<std::string>{"seed differs"});
}

TEST_CASE("the first differing field of two messages is named with both values") {
  const auto differ = [](const auto& a, const auto& b) {
    const auto found = first_difference(msg::to_value(a), msg::to_value(b));
    return found ? found->field + ": " + found->a + " / " + found->b : "same";
  };
  msg::Pose pose, other;
  CHECK(differ(pose, other) == "same");
  other.position_enu_m[2] = 0.1;
  CHECK(differ(pose, other) == "position_enu_m.2: 0 / 0.1");
  msg::Health health, counted;
  counted.counters = {{"late", 2}};
  CHECK(differ(health, counted) == R"(counters.0: missing / {"name":"late","count":2})");
  CHECK(differ(msg::Array<float>({2, 3}), msg::Array<float>({3, 2})) == ": f4[2,3] / f4[3,2]");
  msg::Ping ping, short_ping;
  ping.beam_angle_rad = msg::Array<float>::of({1.0F, NAN});
  short_ping.beam_angle_rad = msg::Array<float>::of({1.0F, 2.0F});
  CHECK(differ(ping, short_ping) == "beam_angle_rad[1]: nan (0x7fc00000) / 2");
  CHECK(differ(pose, health) == "position_enu_m: [0,0,0] / missing");
}
