#include "components/clock/referee.h"

#include <catch2/catch.hpp>

using namespace ensonify;
using clock::Referee;

namespace {

const std::vector<Declaration> kProcesses{{"boat", "stub", {{"pose", "pose/1", 100, {100, 1}}}, {}, false},
                                          {"agent",
                                           "stub",
                                           {{"command", "guidance/1", 100, {10, 1}}, {"mark", "mark/1", 100, {}}},
                                           {{"pose", "pose/1"}},
                                           true}};
constexpr std::size_t kBoat = 0, kAgent = 1;
constexpr std::uint32_t kPose = 0, kCommand = 1, kMark = 2;

Referee referee(std::uint32_t epoch = 1) { return {epoch, wire(kProcesses, {}), kProcesses}; }

protocol::Done done_at(SimTime next, protocol::TopicCounts outputs = {}, bool finish = false) {
  return {1, next, finish, 0, std::move(outputs)};
}

std::string text_of(const std::optional<clock::Breach>& breach) { return breach ? breach->text : ""; }

}  // namespace

TEST_CASE("an honest DONE is counted and has nothing wrong with it") {
  Referee r = referee();
  CHECK_FALSE(r.judge(kAgent, done_at(100_ms, {{kCommand, 1}, {kMark, 12}}), 0_s, 50_ms));
  CHECK(r.published(kCommand) == 1);
  CHECK(r.published(kMark) == 12);
  CHECK_FALSE(r.judge(kAgent, done_at(kNever), 100_ms, 1_s));
}

TEST_CASE("a promise is not taken back") {
  Referee r = referee();
  const auto breach = r.judge(kBoat, done_at(99_ms), 100_ms, 1_s);
  REQUIRE(breach);
  CHECK(breach->code == 3);
  CHECK_THAT(breach->text, Catch::Contains("next: 99000000 ns is before its promise of 100000000 ns"));
}

TEST_CASE("a DONE of another epoch is refused") {
  protocol::Done done = done_at(1_s);
  done.epoch = 2;
  CHECK_THAT(text_of(referee().judge(kBoat, done, 0_s, 1_s)), Catch::Contains("epoch: is 2, the run's is 1"));
  CHECK(text_of(referee(2).judge(kBoat, done, 0_s, 1_s)).empty());
  done.epoch = 1;
  CHECK_THAT(text_of(referee(2).judge(kBoat, done, 0_s, 1_s)), Catch::Contains("epoch: is 1, the run's is 2"));
}

TEST_CASE("counts are of one's own topics and never fall") {
  Referee r = referee();
  CHECK_THAT(text_of(r.judge(kAgent, done_at(1_s, {{kPose, 1}}), 0_s, 1_s)),
             Catch::Contains("topic 0 (boat/pose): is not its own"));
  CHECK_THAT(text_of(r.judge(kAgent, done_at(1_s, {{77, 1}}), 0_s, 1_s)), Catch::Contains("topic 77: is not its own"));
  CHECK_FALSE(r.judge(kAgent, done_at(1_s, {{kCommand, 5}}), 0_s, 1_s));
  CHECK_THAT(text_of(r.judge(kAgent, done_at(2_s, {{kCommand, 4}}), 1_s, 2_s)),
             Catch::Contains("agent/command: count 4 is less than 5 before"));
  CHECK(r.published(kCommand) == 5);
}

TEST_CASE("only who said may_finish ends a run, and not beyond its horizon; again is no mistake") {
  Referee r = referee();
  CHECK_THAT(text_of(r.judge(kBoat, done_at(1_s, {}, true), 0_s, 2_s)), Catch::Contains("may_finish"));
  CHECK_THAT(text_of(r.judge(kAgent, done_at(2_s + SimTime{2}, {}, true), 0_s, 2_s)),
             Catch::Contains("beyond the horizon"));
  CHECK_FALSE(r.judge(kAgent, done_at(2_s + SimTime{1}, {}, true), 0_s, 2_s));
  CHECK_FALSE(r.judge(kAgent, done_at(3_s, {}, true), 2_s, 3_s));
}

TEST_CASE("a declared rate holds with one second of it and two at once; unstated is 10 Hz") {
  Referee r = referee();
  CHECK_FALSE(r.judge(kAgent, done_at(SimTime{1}, {{kCommand, 12}, {kMark, 12}}), 0_s, 0_s));
  CHECK_FALSE(r.judge(kAgent, done_at(100_ms, {{kCommand, 13}}), SimTime{1}, 100_ms));
  const auto breach = r.judge(kAgent, done_at(200_ms, {{kCommand, 15}}), 100_ms, 200_ms);
  CHECK_THAT(text_of(breach), Catch::Contains("agent/command: count 15 after 13: more than 10 Hz with 12 at once"));
  // Far ahead in one grant, as who waits for nobody goes: its own time counts, and no more than it was granted.
  CHECK_FALSE(referee().judge(kBoat, done_at(100_s, {{kPose, 10'000}}), 0_s, kNever));
  CHECK(referee().judge(kBoat, done_at(100_s, {{kPose, 10'000}}), 0_s, 10_s));
}

TEST_CASE("a thousand grants may pass within the finest period, not one more") {
  Referee r = referee();
  SimTime next{0};
  for (int i = 0; i < clock::kMostGrantsPerPeriod; ++i) {
    REQUIRE_FALSE(r.judge(kAgent, done_at(next + SimTime{1}), next, 1_s));
    next += SimTime{1};
  }
  const auto breach = r.judge(kAgent, done_at(next + SimTime{1}), next, 1_s);
  REQUIRE(breach);
  CHECK(breach->code == 4);
  CHECK_THAT(breach->text,
             Catch::Contains("less than its finest period of 10000000 ns"));  // of the poses that it takes
}

TEST_CASE("whoever keeps the pace of its own or its inputs' topics is never taken to stand still") {
  Referee r = referee();
  SimTime next{0};
  for (std::int64_t n = 1; n < 5000; ++n) {  // five grants in each period of 10 ms
    REQUIRE_FALSE(r.judge(kAgent, done_at(n * 2_ms), next, n * 2_ms));
    next = n * 2_ms;
  }
}
