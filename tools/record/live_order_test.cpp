#include <catch2/catch.hpp>

#include "tools/record/live.h"

namespace ensonify::record_tool {

namespace {

msg::Packet packet(const std::string& topic, std::uint32_t publisher, std::uint64_t seq, SimTime t_sim) {
  msg::Packet made;
  made.topic = topic;
  made.envelope.publisher = publisher;
  made.envelope.seq = seq;
  made.envelope.t_sim_ns = t_sim.count();
  made.body = msg::encode_value({std::string(100, 'x')});
  return made;
}

/// What is written, as "topic:seq ".
struct Written {
  std::string text;
  LiveOrder::Write write() {
    return [this](const msg::Packet& p) { text += p.topic + ":" + std::to_string(p.envelope.seq) + " "; };
  }
};

}  // namespace

TEST_CASE("messages of publishers that run ahead of each other are written in the order of records") {
  Written written;
  LiveOrder order(written.write(), 1_s, 1U << 20U);
  order.take(packet("b", 1, 0, 0_ms));
  order.take(packet("b", 1, 1, 100_ms));
  order.take(packet("b", 1, 2, 200_ms));
  order.take(packet("a", 0, 0, 100_ms));
  CHECK(written.text.empty());
  order.take(packet("a", 0, 1, 1150_ms));
  CHECK(written.text == "b:0 a:0 b:1 ");
  order.finish();
  CHECK(written.text == "b:0 a:0 b:1 b:2 a:1 ");
  CHECK(order.kept().at("b").received == 3);
  CHECK(order.kept().at("b").missed == 0);
}

TEST_CASE("what is missing in a topic's seq, and what comes too late, is counted as missed") {
  Written written;
  LiveOrder order(written.write(), 1_s, 1U << 20U);
  order.take(packet("a", 0, 7, 0_s));  // those before it came before us
  order.take(packet("a", 0, 10, 3_s));
  order.take(packet("b", 1, 0, 3_s));
  order.take(packet("a", 0, 11, 5_s));
  order.take(packet("b", 1, 1, 2_s));
  order.finish();
  CHECK(written.text == "a:7 a:10 b:0 a:11 ");
  CHECK(order.kept().at("a").missed == 2);
  CHECK(order.kept().at("a").received == 3);
  CHECK(order.kept().at("b").missed == 1);
}

TEST_CASE("at one time too, what comes behind a later publisher's message is missed") {
  Written written;
  LiveOrder order(written.write(), 1_s, 1U << 20U);
  order.take(packet("b", 1, 0, 0_s));
  order.take(packet("b", 1, 1, 2_s));
  order.take(packet("a", 0, 0, 0_s));
  order.take(packet("c", 2, 0, 0_s));
  order.finish();
  CHECK(written.text == "b:0 c:0 b:1 ");
  CHECK(order.kept().at("a").missed == 1);
}

TEST_CASE("memory is bounded: beyond it the oldest message is written at once") {
  Written written;
  LiveOrder order(written.write(), 5_s, 250);
  for (std::uint64_t seq = 0; seq < 4; ++seq) order.take(packet("a", 0, seq, SimTime{static_cast<std::int64_t>(seq)}));
  CHECK(written.text == "a:0 a:1 ");
}

}  // namespace ensonify::record_tool
