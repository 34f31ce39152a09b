#include <stdlib.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <thread>

#include "components/errors/exit_error.h"
#include "components/runtime/bus/link.h"
#include "components/runtime/bus/observer.h"
#include "components/runtime/bus/router.h"
#include "components/runtime/bus/sockets.h"
#include "messages/motion.h"
#include "messages/terrain.h"

using namespace ensonify;
using bus::Link;

namespace {

/// A private folder for sockets, removed at the end.
struct Folder {
  Folder() {
    char name[] = "/tmp/ensonify-bus-XXXXXX";
    path = mkdtemp(name);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string path;
};

msg::Tile tile_of(std::size_t posts) {
  msg::Tile tile;
  tile.col = 7;
  tile.height_m = msg::Array<float>({posts, posts});
  for (std::size_t i = 0; i < tile.height_m.size(); ++i) tile.height_m[i] = static_cast<float>(i);
  tile.sediment = msg::Array<std::uint8_t>({posts, posts});
  return tile;
}

msg::Packet packet_of(const msg::Tile& tile, std::uint64_t seq = 0, std::uint32_t epoch = 1) {
  msg::Packet packet;
  packet.topic = "pager/tile";
  packet.body = msg::encode(tile);
  packet.envelope.epoch = epoch;
  packet.envelope.topic_id = 3;
  packet.envelope.type_hash = msg::type_hash("tile/1");
  packet.envelope.seq = seq;
  packet.envelope.frame_count = static_cast<std::uint32_t>(msg::kFirstArrayFrame + packet.body.arrays.size());
  return packet;
}

/// A publisher and a subscriber whose edge is proven.
struct Pair {
  explicit Pair(bool tcp, std::size_t max_bytes = 1 << 24)
      : clock({.tcp = tcp, .run_dir = folder.path}),
        publisher("pub", clock.endpoint(), {.tcp = tcp, .run_dir = folder.path}, 16),
        subscriber("sub", clock.endpoint(), {.tcp = tcp, .run_dir = folder.path}, 16) {
    subscriber.subscribe(
        {{"pager/tile", 3, "tile/1", publisher.sync_endpoint(), "e0", max_bytes, "pager", 0, {1000, 1}}}, 1);
    const Link::Event event = publisher.wait();
    CHECK(event.kind == Link::Event::kTokens);
    CHECK(event.tokens == std::vector<std::string>{"e0"});
  }
  Folder folder;
  bus::Router clock;
  Link publisher;
  Link subscriber;
};

}  // namespace

TEST_CASE("a message arrives whole over ipc and tcp, its arrays viewing received frames") {
  for (const bool tcp : {false, true}) {
    Pair pair(tcp);
    const msg::Tile sent = tile_of(129);
    for (std::uint64_t seq = 0; seq < 100; ++seq)
      pair.publisher.publish(packet_of(sent, seq));  // each over what is held
    pair.subscriber.wait_arrived({{3, 100}});
    const auto packets = pair.subscriber.take();
    REQUIRE(packets.size() == 100);
    CHECK(packets[99].envelope.seq == 99);
    const auto received = msg::decode<msg::Tile>(packets[0].body, 1 << 24);
    CHECK(received.col == 7);
    CHECK(received.height_m == sent.height_m);
    CHECK(reinterpret_cast<const std::byte*>(received.height_m.data()) == packets[0].body.arrays[0].data);
  }
}

namespace {

/// What a subscriber says of a message that has something wrong; the message comes at once, nothing asked for it.
PeerError refusal_of(const std::function<void(msg::Packet&)>& spoil, std::uint64_t good_ones = 0) {
  Pair pair(false, 1 << 17);
  for (std::uint64_t seq = 0; seq < good_ones; ++seq) pair.publisher.publish(packet_of(tile_of(3), seq));
  msg::Packet packet = packet_of(tile_of(3), good_ones);
  spoil(packet);
  pair.publisher.publish(packet);
  pair.publisher.flush();
  try {
    pair.subscriber.wait();
  } catch (const PeerError& e) {
    return e;
  }
  return {kExitOk, "", ""};
}

void check_refused(const std::function<void(msg::Packet&)>& spoil, const std::string& text, int code = kExitDied) {
  const PeerError e = refusal_of(spoil, 2);
  CHECK(e.culprit == "pager");
  CHECK(e.code == code);
  CHECK_THAT(e.what(), Catch::StartsWith("pager ") && Catch::Contains("pager/tile: seq 2") && Catch::Contains(text));
}

}  // namespace

TEST_CASE("what is wrong with a message is said of its sender, with topic, seq and field") {
  using msg::Packet;
  check_refused([](Packet& p) { p.body = msg::encode(tile_of(200)); }, "bytes, declared at most 131072");
  check_refused([](Packet& p) { p.envelope.type_hash = msg::type_hash("tile/2"); }, "type hash: is not that of tile/1");
  check_refused([](Packet& p) { p.envelope.epoch = 0; }, "epoch: is 0");
  check_refused([](Packet& p) { p.envelope.publisher = 7; }, "publisher: is 7");
  check_refused([](Packet& p) { p.envelope.topic_id = 4; }, "envelope: topic id is 4");
  check_refused([](Packet& p) { p.envelope.version = 2; }, "envelope: wire version 2");
  check_refused([](Packet& p) { p.envelope.frame_count = 9; }, "envelope: frame count does not match");
  check_refused([](Packet& p) { p.envelope.t_sim_ns = -1; }, "t_sim: -1 ns");
  check_refused([](Packet& p) { p.envelope.t_sim_ns = 5'000'000'001; }, "t_sim: 5000000001 ns");
  check_refused([](Packet& p) { p.envelope.seq = 3; }, "is missing, 3 came", kExitDataLost);
  check_refused(
      [](Packet& p) {
        p.envelope.seq = 1;
        p.topic += std::string("\0x", 2);
      },
      "topic id is 3");
}

TEST_CASE("a publisher is held to its rate in sim time, whatever the wall clock says") {
  Pair pair(false);
  std::uint64_t seq = 0;
  const auto publish = [&](std::uint64_t n, std::int64_t t_ns) {
    for (std::uint64_t i = 0; i < n; ++i) {
      msg::Packet packet = packet_of(tile_of(3), seq++);
      packet.envelope.t_sim_ns = t_ns;
      pair.publisher.publish(packet);
    }
    pair.publisher.flush();
  };
  publish(1002, 0);
  publish(500, 500'000'000);
  pair.subscriber.wait_arrived({{3, 1502}});
  publish(1, 500'000'000);
  CHECK_THROWS_WITH(pair.subscriber.wait_arrived({{3, 1503}}),
                    Catch::Contains("seq 1502") && Catch::Contains("1000 Hz"));
}

TEST_CASE("a later epoch comes over the same lines, and what is left of the one before is dropped") {
  Pair pair(false);
  pair.publisher.publish(packet_of(tile_of(3), 0));
  pair.publisher.publish(packet_of(tile_of(5), 1));
  pair.publisher.flush();
  pair.subscriber.wait_arrived({{3, 2}});
  pair.subscriber.expect_until(kNever);
  pair.subscriber.subscribe(
      {{"pager/tile", 3, "tile/1", pair.publisher.sync_endpoint(), "e0", 1 << 24, "pager", 0, {1000, 1}}}, 2);
  CHECK(pair.subscriber.take().empty());
  pair.publisher.publish(packet_of(tile_of(3), 2));  // late, of the first
  pair.publisher.publish(packet_of(tile_of(9), 0, 2));
  pair.publisher.flush();
  pair.subscriber.wait_arrived({{3, 1}});
  const auto packets = pair.subscriber.take();
  REQUIRE(packets.size() == 1);
  CHECK(packets[0].envelope.epoch == 2);
  pair.publisher.publish(packet_of(tile_of(3), 1, 3));
  pair.publisher.flush();
  CHECK_THROWS_WITH(pair.subscriber.wait_arrived({{3, 2}}), Catch::Contains("epoch: is 3"));
}

TEST_CASE("whoever will read nothing more keeps nothing, and still knows what has come") {
  Pair pair(false);
  pair.subscriber.expect_until(kNever);
  for (std::uint64_t seq = 0; seq < 100; ++seq) pair.publisher.publish(packet_of(tile_of(3), seq));
  pair.publisher.flush();
  pair.subscriber.wait_arrived({{3, 100}});
  CHECK(pair.subscriber.take().empty());
}

TEST_CASE("what was counted and never comes is lost by its publisher") {
  Pair pair(false);
  pair.publisher.publish(packet_of(tile_of(3)));
  pair.publisher.flush();
  pair.subscriber.wait_arrived({{3, 1}});
  CHECK(pair.subscriber.wait_arrived({{3, 2}}, std::chrono::milliseconds(50)) == Link::Arrived::kNothing);
  try {
    pair.subscriber.refuse_missing({{3, 2}});
    FAIL("it arrived");
  } catch (const PeerError& e) {
    CHECK(e.code == kExitDataLost);
    CHECK(e.culprit == "pager");
    CHECK_THAT(e.what(), Catch::Contains("its DONE counted 2, 1 have come"));
  }
}

TEST_CASE("what is wrong of a publisher that may be lost ends its topic, with the time that it gives") {
  Pair pair(false);
  bus::Subscription subscription{"pager/tile", 3, "tile/1", pair.publisher.sync_endpoint(), "e0", 1 << 24,
                                 "pager",      0, {1000, 1}};
  subscription.may_be_lost = true;
  pair.subscriber.subscribe({subscription}, 1);
  const auto publish = [&](std::uint64_t seq, std::int64_t t_ns, std::uint32_t rank) {
    msg::Packet packet = packet_of(tile_of(3), seq);
    packet.envelope.t_sim_ns = t_ns;
    packet.envelope.publisher = rank;
    pair.publisher.publish(packet);
  };
  publish(0, 100, 0);
  publish(1, 200, 7);
  publish(2, 300, 0);
  pair.publisher.flush();
  pair.subscriber.wait_arrived({{3, 3}});
  CHECK(pair.subscriber.take().size() == 1);
  const auto unusable = pair.subscriber.take_unusable();
  REQUIRE(unusable.size() == 1);
  CHECK(unusable[0].topic_id == 3);
  CHECK(unusable[0].t == SimTime{200});
  CHECK_THAT(unusable[0].why.what(), Catch::Contains("pager/tile: seq 1: publisher: is 7"));
  CHECK(pair.subscriber.take_unusable().empty());
}

TEST_CASE("a full sync queue holds the publisher back instead of losing a message") {
  Pair pair(false);
  constexpr std::uint64_t kMessages = 400;  // 64 KiB each: far more than 16 queued and the kernel's buffers
  std::thread publisher([&] {
    for (std::uint64_t seq = 0; seq < kMessages; ++seq) pair.publisher.publish(packet_of(tile_of(129), seq));
  });
  pair.subscriber.wait_arrived({{3, kMessages}});
  publisher.join();
  const auto packets = pair.subscriber.take();
  REQUIRE(packets.size() == kMessages);
  for (std::uint64_t seq = 0; seq < kMessages; ++seq) REQUIRE(packets[seq].envelope.seq == seq);
}

TEST_CASE("frames are made only for subscribed topics, and held until the flush") {
  Pair pair(false);
  msg::Packet packet = packet_of(tile_of(33));  // an array of more than 4 KiB: frames share it
  const auto& owner = packet.body.arrays[0].owner;
  const long alone = owner.use_count();
  packet.topic = "pager/til";
  pair.publisher.publish(packet);
  packet.topic = "pager/tiles";
  pair.publisher.publish(packet);
  CHECK(owner.use_count() == alone);
  packet.topic = "pager/tile";
  pair.publisher.publish(packet);
  CHECK(owner.use_count() == alone + 1);
  pair.publisher.flush();
  pair.subscriber.wait_arrived({{3, 1}});
  CHECK(pair.subscriber.take().size() == 1);
}

TEST_CASE("what is for viewers alone reaches them, is watched while they are there, and no participant gets it") {
  Pair pair(false);
  msg::Packet packet = packet_of(tile_of(3));
  packet.topic = "pager/tile";  // the subscriber's
  CHECK_FALSE(pair.publisher.is_watched("pager/tile"));
  pair.publisher.publish_live(packet);
  std::optional<bus::Observer> observer(
      std::in_place, std::vector<bus::Observer::Topic>{{"pager/tile", pair.publisher.live_endpoint()}});
  const auto until = [&](bool watched) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    do pair.publisher.flush();  // asks again who is there
    while (pair.publisher.is_watched("pager/tile") != watched && std::chrono::steady_clock::now() < deadline);
    return pair.publisher.is_watched("pager/tile") == watched;
  };
  REQUIRE(until(true));
  CHECK_FALSE(pair.publisher.is_watched("pager/til"));
  packet.envelope.seq = 7;
  pair.publisher.publish_live(packet);
  const auto seen = observer->next(std::chrono::steady_clock::now() + std::chrono::seconds(20));
  REQUIRE(seen);
  CHECK(seen->envelope.seq == 7);
  observer.reset();
  CHECK(until(false));
  packet.envelope.seq = 0;
  pair.publisher.publish(packet);
  pair.publisher.flush();
  pair.subscriber.wait_arrived({{3, 1}});  // the first that it gets
  CHECK(pair.subscriber.take().size() == 1);
}

TEST_CASE("a topic stays subscribed until its last subscriber has left") {
  zmq::context_t context;
  zmq::socket_t xpub(context, zmq::socket_type::xpub), first(context, zmq::socket_type::sub),
      second(context, zmq::socket_type::sub);
  xpub.bind("inproc://topics");
  first.connect("inproc://topics");
  second.connect("inproc://topics");
  const std::string pose("boat/pose\0", 10);
  bus::Subscribers subscribers;
  CHECK(subscribers.empty());
  first.set(zmq::sockopt::subscribe, pose);
  second.set(zmq::sockopt::subscribe, pose);
  CHECK(subscribers.read(xpub) == std::vector<std::string>{pose});
  CHECK(subscribers.has_subscriber("boat/pose"));
  CHECK_FALSE(subscribers.has_subscriber("boat/poses"));
  CHECK_FALSE(subscribers.has_subscriber("boat"));
  first.set(zmq::sockopt::unsubscribe, pose);
  CHECK(subscribers.read(xpub).empty());
  CHECK(subscribers.has_subscriber("boat/pose"));
  second.set(zmq::sockopt::unsubscribe, pose);
  second.set(zmq::sockopt::subscribe, "");  // a viewer of everything
  CHECK(subscribers.read(xpub) == std::vector<std::string>{""});
  CHECK(subscribers.has_subscriber("boat"));
  second.set(zmq::sockopt::unsubscribe, "");
  subscribers.read(xpub);
  CHECK(subscribers.empty());
}

TEST_CASE("small messages wait for the flush only up to 16 KiB together") {
  Folder folder;
  bus::Router clock({.run_dir = folder.path});
  Link publisher("pub", clock.endpoint(), {.run_dir = folder.path}, 16);
  zmq::context_t context;
  zmq::socket_t subscriber(context, zmq::socket_type::sub);
  subscriber.set(zmq::sockopt::rcvtimeo, 10'000);  // a fault fails the test instead of stopping it
  subscriber.set(zmq::sockopt::linger, 0);
  subscriber.connect(publisher.sync_endpoint());
  subscriber.set(zmq::sockopt::subscribe, std::string("pager/tile\0", 11));
  subscriber.set(zmq::sockopt::subscribe, "~e0");
  REQUIRE(publisher.wait().tokens == std::vector<std::string>{"e0"});

  const msg::Tile tile = tile_of(15);
  const std::size_t bytes = packet_of(tile).body.size(), count = 200;
  REQUIRE(bytes < 2000);
  for (std::size_t seq = 0; seq < count; ++seq) publisher.publish(packet_of(tile, seq));
  const auto expect_next = [&](std::size_t seq) {
    std::vector<zmq::message_t> frames;
    REQUIRE(bus::receive_frames(subscriber, frames));
    const msg::Packet arrived = bus::to_packet(std::move(frames));
    CHECK(arrived.envelope.seq == seq);
  };
  std::size_t seq = 0;
  for (; seq < count - 1 - (1 << 14) / bytes; ++seq) expect_next(seq);
  publisher.flush();
  for (; seq < count; ++seq) expect_next(seq);
}

TEST_CASE("wall-clock facts travel behind the arrays and stay out of the body") {
  msg::Packet packet = packet_of(tile_of(3));
  packet.wall_facts = msg::Buffer::own(std::string("{\"cost_s\":1}"));
  packet.envelope.flags = msg::kFlagWallFacts;
  packet.envelope.frame_count += 1;
  const msg::Packet back = bus::to_packet(bus::to_frames(packet));
  CHECK(back.wall_facts.text() == "{\"cost_s\":1}");
  CHECK(back.body.arrays.size() == packet.body.arrays.size());
}

TEST_CASE("frames that are no message are refused, not crashed on") {
  std::vector<zmq::message_t> none(2);
  CHECK_THROWS_AS(bus::to_packet(std::move(none)), msg::DecodeError);
  auto frames = bus::to_frames(packet_of(tile_of(3)));
  frames.pop_back();
  CHECK_THROWS_WITH(bus::to_packet(std::move(frames)), Catch::Contains("frame count"));
}

TEST_CASE("addresses that cannot be used are the user's mistake, with the reason") {
  Folder folder;
  const std::string long_dir = folder.path + "/" + std::string(100, 'd');
  CHECK_THROWS_WITH(bus::Router({.run_dir = long_dir}), Catch::Contains("at most 107 bytes"));
  CHECK_THROWS_WITH(bus::Router({.tcp = true, .host = "0.0.0.0"}),
                    Catch::Contains("only 127.0.0.1 is allowed without keys"));
  CHECK_THROWS_WITH(bus::Router({.run_dir = folder.path + "/nowhere"}), Catch::Contains("cannot bind"));
}

TEST_CASE("the router answers every request, and stops waiting on command") {
  Folder folder;
  bus::Router router({.run_dir = folder.path});
  CHECK_FALSE(router.wait(std::chrono::steady_clock::now()));
  std::thread clock([&] {
    while (true) {
      if (const auto message = router.wait(std::nullopt)) {
        CHECK(router.send(message->from, message->text + "!"));
        return;
      }
    }
  });
  bus::ClockQuery query(router.endpoint());
  CHECK(query.ask("hello", std::chrono::seconds(10)) == "hello!");
  clock.join();
  CHECK_FALSE(router.send("nobody", "x"));
}
