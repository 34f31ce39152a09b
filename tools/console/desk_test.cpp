#include "tools/console/desk.h"

#include <catch2/catch.hpp>
#include <deque>

#include "components/view/ping_view.h"
#include "messages/health.h"
#include "messages/sonar.h"
#include "messages/terrain.h"
#include "tools/console/blind.h"

using namespace ensonify;
using namespace ensonify::console;

namespace {

/// A source that says what a test puts into it.
class TestSource : public Source {
 public:
  std::deque<msg::Packet>& said;
  std::set<std::string>& wanted;
  std::string word = "running";
  std::string fault;  // thrown by poll
  TestSource(std::deque<msg::Packet>& packets, std::set<std::string>& topics) : said(packets), wanted(topics) {}

  msg::ConsoleState state() const override {
    msg::ConsoleState state;
    state.kind = "run";
    state.state = word;
    state.topics = {{"bow/ping", "ping/1", "bow", ""},
                    {"side/ping_main", "ping/1", "side", ""},
                    {"fls/ping", "ping/1", "fls", ""},
                    {"fls/view", "view/1", "fls", ""},
                    {"fls/soundings", "soundings/1", "fls", ""},
                    {"nav/health", "health/1", "nav", ""},
                    {"side/bottom_track_main", "bottom_track/1", "side", ""},
                    {"pager/chart_view", "chart/1", "pager", ""},
                    {"boat/pose", "pose/1", "boat", ""},
                    {"bow/soundings", "soundings/1", "bow", ""}};
    return state;
  }
  std::string beam_axis(const std::string& publisher) const override { return publisher == "bow" ? "forward" : "down"; }
  std::string folder() const override { return ""; }
  void want(const std::set<std::string>& topics) override { wanted = topics; }
  void poll(WallTime, std::chrono::milliseconds, const Take& take) override {
    if (!fault.empty()) throw std::runtime_error(fault);
    while (!said.empty()) {
      msg::Packet packet = said.front();
      said.pop_front();
      if (wanted.contains(packet.topic)) take(packet);
    }
  }
  void command(const msg::ConsoleCommand&) override {}
};

msg::Packet ping(const std::string& topic, std::size_t beams, std::uint64_t seq) {
  msg::Ping content;
  content.sample_period_s = 1e-4;
  content.applied.sound_speed_mps = 1500.0;
  content.beam_angle_rad = msg::Array<float>({beams});
  content.amplitude_upa = msg::Array<float>({beams, 100});
  for (float& value : content.amplitude_upa.flat()) value = 1.0F;
  msg::Packet packet{topic, {}, msg::encode(content), {}};
  packet.envelope.seq = seq;
  packet.envelope.type_hash = msg::type_hash(msg::Ping::kType);
  return packet;
}

struct Scene {
  std::deque<msg::Packet> said;
  std::set<std::string> wanted;
  WallTime now = std::chrono::steady_clock::now();
  TestSource* source = new TestSource(said, wanted);  // the desk's
  Desk desk{std::unique_ptr<Source>(source)};
  Flow flow{now};

  void watch(const std::vector<std::string>& topics) {
    msg::ConsoleWatch wish;
    for (const auto& topic : topics) wish.topics.push_back({topic, 16, false, 0.0, 0.0});
    flow.watch(wish, now);
    desk.settle(flow);
  }
};

}  // namespace

TEST_CASE("only topics that somebody watches are asked for") {
  Scene scene;
  scene.desk.add(scene.flow);
  CHECK(scene.wanted.empty());
  scene.watch({"bow/view", "side/view_main"});
  CHECK(scene.wanted == std::set<std::string>{"bow/ping", "bow/soundings", "side/ping_main"});
  scene.watch({"nav/health"});
  CHECK(scene.wanted == std::set<std::string>{"nav/health"});
}

TEST_CASE("alarms and numbers ask for the topics that they are made of") {
  Scene scene;
  scene.desk.add(scene.flow);
  scene.watch({"alarms"});
  CHECK(scene.wanted ==
        std::set<std::string>{"bow/soundings", "fls/soundings", "nav/health", "side/bottom_track_main"});
  msg::ConsoleWatch wish;
  wish.topics = {{"values", 16, false, 0.0, 0.0}};
  wish.values = {"bow/ping.pings_per_s", "no/topic.x"};
  scene.flow.watch(wish, scene.now);
  scene.desk.settle(scene.flow);
  CHECK(scene.wanted == std::set<std::string>{"bow/ping"});
}

TEST_CASE("who comes later gets the alarms that there are, another run begins without") {
  Scene scene;
  scene.desk.add(scene.flow);
  scene.watch({"alarms"});
  msg::Health health;
  health.state = "failed";
  scene.said = {{"nav/health", {}, msg::encode(health), {}}};
  scene.desk.poll(scene.now);
  const auto count = [&](Flow& flow) {
    const auto sending = flow.next(scene.now);
    REQUIRE(sending);
    return msg::decode<msg::ConsoleAlarms>(scene.desk.message_of(*sending).body, 1 << 20).alarms.size();
  };
  CHECK(count(scene.flow) == 1);
  Flow late(scene.now);
  msg::ConsoleWatch wish;
  wish.topics = {{"alarms", 16, false, 0.0, 0.0}};
  late.watch(wish, scene.now);
  scene.desk.add(late);
  scene.desk.settle(late);
  CHECK(count(late) == 1);
  scene.desk.remove(late);
  for (const char* word : {"ended", "running"}) {
    scene.source->word = word;
    scene.now += std::chrono::seconds(1);
    scene.desk.poll(scene.now);
  }
  CHECK(count(scene.flow) == 0);
}

TEST_CASE("pings become pictures of the size that is watched, two sides lines, all with the number of their ping") {
  Scene scene;
  scene.desk.add(scene.flow);
  scene.watch({"bow/view", "side/view_main"});
  scene.said = {ping("bow/ping", 5, 3), ping("side/ping_main", 2, 9)};
  scene.desk.poll(scene.now);
  const auto line = scene.flow.next(scene.now);
  REQUIRE(line);
  CHECK(line->offer.topic == "side/view_main");
  const auto picture = scene.flow.next(scene.now);
  REQUIRE(picture);
  CHECK(picture->offer.way == Way::picture);
  const msg::Packet sent = scene.desk.message_of(*picture);
  CHECK(sent.topic == "bow/view");
  CHECK(sent.envelope.seq == 3);
  CHECK(sent.envelope.type_hash == msg::type_hash("view/1"));
  const auto view = msg::decode<msg::View>(sent.body, sent.body.size());
  CHECK(view.level.shape() == std::vector<std::size_t>{5, 15});
  CHECK(view.beam_axis == "forward");
}

TEST_CASE("a head's own pictures are taken, made as wide as they are watched, and no other is made") {
  Scene scene;
  scene.desk.add(scene.flow);
  scene.watch({"fls/view"});
  CHECK(scene.wanted == std::set<std::string>{"fls/view"});
  const auto& topics = scene.desk.state().topics;
  CHECK(std::count_if(topics.begin(), topics.end(), [](const auto& t) { return t.name == "fls/view"; }) == 1);
  CHECK(std::none_of(topics.begin(), topics.end(), [](const auto& t) { return t.name == "fls/ping"; }));
  msg::View made;
  made.beam_angle_rad = msg::Array<float>({4});
  made.level = msg::Array<std::uint8_t>({4, 100});
  for (std::uint8_t& value : made.level.flat()) value = 61;
  made.level_floor_db = 30.0;
  made.cell_m = 0.1;
  scene.said = {{"fls/view", {}, msg::encode(made), {}}};
  scene.desk.poll(scene.now);
  const auto picture = scene.flow.next(scene.now);
  REQUIRE(picture);
  CHECK(picture->offer.way == Way::picture);
  const msg::Packet sent = scene.desk.message_of(*picture);
  const auto view = msg::decode<msg::View>(sent.body, sent.body.size());
  CHECK(view.level.shape() == std::vector<std::size_t>{4, 15});
  CHECK(view.level_floor_db + (view.level(2, 3) - 1) * view.level_step_db == 60.0);
}

TEST_CASE("a waterfall that is wished on the ground has the altitude of its own bottom track") {
  Scene scene;
  scene.desk.add(scene.flow);
  msg::ConsoleWatch wish;
  wish.topics = {{"side/view_main", 1024, false, 0.0, 0.0}};
  wish.ground = {"side/view_main"};
  scene.flow.watch(wish, scene.now);
  scene.desk.settle(scene.flow);
  CHECK(scene.wanted == std::set<std::string>{"side/bottom_track_main", "side/ping_main"});
  const auto altitude = [&] {
    scene.desk.poll(scene.now);
    const auto line = scene.flow.next(scene.now);
    REQUIRE(line);
    return msg::decode<msg::View>(scene.desk.message_of(*line).body, 1 << 20).ground_altitude_m;
  };
  scene.said = {ping("side/ping_main", 2, 0)};
  CHECK(altitude() == 0.0);  // not known yet
  msg::BottomTrack bottom;
  bottom.valid = true;
  bottom.altitude_m = 3.5;
  scene.said = {{"side/bottom_track_main", {}, msg::encode(bottom), {}}, ping("side/ping_main", 2, 1)};
  CHECK(altitude() == 3.5);
}

TEST_CASE("who comes later gets the states and pictures that there are") {
  Scene scene;
  scene.desk.add(scene.flow);
  scene.watch({"nav/health", "bow/view"});
  msg::Packet health{"nav/health", {}, msg::encode(msg::Health{}), {}};
  scene.said = {health, ping("bow/ping", 4, 0)};
  scene.desk.poll(scene.now);
  Flow late(scene.now);
  msg::ConsoleWatch wish;
  wish.topics = {{"nav/health", 16, false, 0.0, 0.0}, {"bow/view", 16, false, 0.0, 0.0}};
  late.watch(wish, scene.now);
  scene.desk.add(late);
  scene.desk.settle(late);
  CHECK(late.next(scene.now)->offer.topic == "nav/health");
  CHECK(late.next(scene.now)->offer.topic == "bow/view");
  scene.desk.remove(late);
}

TEST_CASE("a picture has the detections of its own ping") {
  Scene scene;
  scene.desk.add(scene.flow);
  scene.watch({"bow/view"});
  msg::Soundings soundings;
  soundings.valid = msg::Array<std::uint8_t>::of({1});
  soundings.beam_angle_rad = msg::Array<float>::of({0.1F});
  soundings.travel_time_s = msg::Array<float>::of({0.01F});
  soundings.applied.sound_speed_mps = 1500.0;
  soundings.ping = 1;
  scene.said = {{"bow/soundings", {}, msg::encode(soundings), {}}, ping("bow/ping", 5, 0)};
  scene.desk.poll(scene.now);
  auto sending = scene.flow.next(scene.now);
  REQUIRE(sending);
  const auto finds = [&] {
    return msg::decode<msg::View>(scene.desk.message_of(*sending).body, 1 << 20).find_range_m.size();
  };
  CHECK(finds() == 0);  // they were another's
  scene.flow.drawn("bow/view", 0, scene.now);
  soundings.ping = 0;
  scene.said = {{"bow/soundings", {}, msg::encode(soundings), {}}, ping("bow/ping", 5, 1)};
  scene.desk.poll(scene.now);
  sending = scene.flow.next(scene.now);
  REQUIRE(sending);
  CHECK(finds() == 1);
}

TEST_CASE("a chart is asked for until there is one, and again of another run") {
  Scene scene;
  scene.desk.add(scene.flow);
  scene.watch({"relief"});
  CHECK(scene.wanted.contains("pager/chart_view"));
  msg::Chart chart;
  chart.spacing_m = 10.0;
  chart.east_m = chart.north_m = 20.0;
  chart.height_m = msg::Array<float>({3, 3});
  scene.said = {{"pager/chart_view", {}, msg::encode(chart), {}}};
  scene.desk.poll(scene.now);
  CHECK_FALSE(scene.wanted.contains("pager/chart_view"));
  CHECK(scene.flow.next(scene.now)->offer.topic == "relief");
  for (const char* word : {"ended", "running"}) {
    scene.source->word = word;
    scene.desk.poll(scene.now);
  }
  CHECK(scene.wanted.contains("pager/chart_view"));
}

TEST_CASE("whom the truth is withheld from is offered and asks for instruments alone") {
  std::deque<msg::Packet> said;
  std::set<std::string> wanted;
  Desk desk(blind(std::make_unique<TestSource>(said, wanted)));
  for (const msg::ConsoleTopic& topic : desk.state().topics) {
    CHECK(topic.type != "pose/1");
    CHECK(topic.type != "health/1");
  }
  const WallTime now = std::chrono::steady_clock::now();
  Flow flow(now);
  desk.add(flow);
  msg::ConsoleWatch wish;
  for (const char* topic : {"boat/pose", "nav/health", "track", "alarms", "values", "bow/view"})
    wish.topics.push_back({topic, 16, false, 0.0, 0.0});
  wish.values = {"boat/pose.heading_grid_rad"};
  flow.watch(wish, now);
  desk.settle(flow);
  CHECK_FALSE(wanted.contains("boat/pose"));
  CHECK_FALSE(wanted.contains("nav/health"));
  CHECK(wanted.contains("bow/ping"));
  desk.remove(flow);
}

TEST_CASE("another run of the same name begins with an empty chart") {
  Scene scene;
  scene.desk.add(scene.flow);
  scene.watch({"cells"});
  msg::Soundings soundings;
  soundings.valid = msg::Array<std::uint8_t>::of({1});
  soundings.position_enu_m = msg::Array<double>({1, 3});
  soundings.position_enu_m(0, 2) = -20.0;
  scene.said = {{"bow/soundings", {}, msg::encode(soundings), {}}};
  scene.desk.poll(scene.now);
  Survey::Seen seen;
  CHECK(scene.desk.survey().new_cells(seen));
  for (const char* word : {"ended", "running"}) {
    scene.source->word = word;
    CHECK(scene.desk.poll(scene.now));
  }
  seen = {};
  CHECK_FALSE(scene.desk.survey().new_cells(seen));
}

TEST_CASE("a source that fails is named, and polled again") {
  Scene scene;
  scene.desk.add(scene.flow);
  scene.watch({"bow/view"});
  scene.source->fault = "the file has gone";
  CHECK(scene.desk.poll(scene.now));
  CHECK(scene.desk.state().message == "the file has gone");
  scene.source->fault.clear();
  scene.said = {ping("bow/ping", 5, 0)};
  scene.desk.poll(scene.now);
  CHECK(scene.flow.next(scene.now));
}

TEST_CASE("a ping without samples is no picture") {
  Scene scene;
  msg::Ping empty;
  empty.beam_angle_rad = msg::Array<float>({4});
  auto packet = std::make_shared<msg::Packet>(msg::Packet{"bow/ping", {}, msg::encode(empty), {}});
  const Sending sending{{"bow/view", Way::picture, packet, scene.now}, {}};
  CHECK_THROWS_AS(scene.desk.message_of(sending), NoPicture);
}

TEST_CASE("topics of pictures stand beside those of pings") {
  CHECK(view_topic_of("bow/ping") == "bow/view");
  CHECK(view_topic_of("side/ping_main") == "side/view_main");
}
