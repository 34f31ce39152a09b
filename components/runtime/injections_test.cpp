#include "components/runtime/injections.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>

#include "components/errors/exit_error.h"
#include "messages/health.h"

using namespace ensonify;
using namespace std::chrono_literals;

namespace {

struct Sent {
  std::size_t port;
  msg::Health message;
};

/// A process `nav` with the outputs `gnss` and `health`: message n is sent at n seconds on both.
std::vector<Sent> sent_by(const Injection& what, int count = 10, std::uint64_t seed = 1) {
  std::vector<Sent> sent;
  std::vector<std::string> said;
  Injector injector({what}, "nav", {"gnss", "health"}, seed, [&](const std::string& text) { said.push_back(text); });
  const Injector::Publish publish = [&](std::size_t port, const msg::Body& body, const msg::Buffer&) {
    sent.push_back({port, msg::decode<msg::Health>(body, body.size())});
  };
  for (int n = 0; n < count; ++n) {
    const SimTime now = std::chrono::seconds(n);
    injector.begin_event(now, publish);
    for (const std::size_t port : {0U, 1U}) {
      msg::Health message;
      message.stamp_ns = now.count();
      message.state = "ok";
      injector.pass(now, port, msg::encode(message), {}, publish);
    }
  }
  CHECK(said.size() <= 1);
  return sent;
}

std::vector<int> stamps_s(const std::vector<Sent>& sent, std::size_t port = 0) {
  std::vector<int> stamps;
  for (const Sent& one : sent) {
    if (one.port == port) stamps.push_back(static_cast<int>(one.message.stamp_ns / 1'000'000'000));
  }
  return stamps;
}

Injection of(Injection::Kind kind, const std::string& target = "nav/gnss") {
  Injection one;
  one.kind = kind;
  one.target = target;
  one.from = 3s, one.to = 6s;
  return one;
}

}  // namespace

TEST_CASE("a muted output is silent for its time, and others are not") {
  const auto sent = sent_by(of(Injection::Kind::kMute));
  CHECK(stamps_s(sent) == std::vector<int>{0, 1, 2, 6, 7, 8, 9});
  CHECK(stamps_s(sent, 1).size() == 10);
  const auto whole = sent_by(of(Injection::Kind::kMute, "nav"));  // but for its health
  CHECK(stamps_s(whole) == std::vector<int>{0, 1, 2, 6, 7, 8, 9});
  CHECK(stamps_s(whole, 1).size() == 10);
  CHECK(stamps_s(sent_by(of(Injection::Kind::kMute, "other/gnss"))).size() == 10);
}

TEST_CASE("messages are lost with their probability, the same ones for the same seed") {
  Injection drop = of(Injection::Kind::kDrop);
  drop.share = 0.3;
  drop.from = 0s, drop.to = 10000s;
  const auto first = stamps_s(sent_by(drop, 10000)), again = stamps_s(sent_by(drop, 10000)),
             other = stamps_s(sent_by(drop, 10000, 2));
  CHECK(first == again);
  CHECK(first != other);
  CHECK(std::abs(static_cast<double>(first.size()) - 7000.0) < 200.0);  // 4 sd of 46
}

TEST_CASE("a delayed message comes at the publisher's event after its delay, none overtakes") {
  Injection delay = of(Injection::Kind::kDelay);
  delay.by = 2500ms;
  delay.to = 4s;
  std::vector<int> when;
  std::vector<Sent> sent;
  Injector injector({delay}, "nav", {"gnss"}, 1, [](const std::string&) {});
  int now_s = 0;
  const Injector::Publish publish = [&](std::size_t port, const msg::Body& body, const msg::Buffer&) {
    when.push_back(now_s);
    sent.push_back({port, msg::decode<msg::Health>(body, body.size())});
  };
  for (; now_s < 10; ++now_s) {
    injector.begin_event(std::chrono::seconds(now_s), publish);
    msg::Health message;
    message.stamp_ns = SimTime(std::chrono::seconds(now_s)).count();
    injector.pass(std::chrono::seconds(now_s), 0, msg::encode(message), {}, publish);
  }
  CHECK(stamps_s(sent) == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(when == std::vector<int>{0, 1, 2, 6, 6, 6, 6, 7, 8, 9});
}

TEST_CASE("a corrupt message has another value in a field, and all else as it was") {
  Injection corrupt = of(Injection::Kind::kCorrupt);
  corrupt.field = "state", corrupt.value = "failed";
  const auto sent = sent_by(corrupt);
  REQUIRE(stamps_s(sent).size() == 10);
  for (const Sent& one : sent) {
    const bool wrong =
        one.port == 0 && one.message.stamp_ns >= SimTime(3s).count() && one.message.stamp_ns < SimTime(6s).count();
    CHECK(one.message.state == (wrong ? "failed" : "ok"));
  }
  corrupt.field = "no_such";
  CHECK_THROWS_WITH(sent_by(corrupt), "inject: corrupt: nav/gnss has no value no_such that is no array");
}

TEST_CASE("a process is killed before its first event at that time, and its signal is named") {
  Injection kill = of(Injection::Kind::kKill, "nav");
  kill.signal = SIGSEGV;
  CHECK_NOTHROW(sent_by(kill, 3));  // up to 2 s: nothing
  int signal = 0;
  try {
    sent_by(kill, 10);
  } catch (const InjectedKill& killed) {
    signal = killed.signal;
  }
  CHECK(signal == SIGSEGV);
}

TEST_CASE("a paused process stands still for its time, and goes on") {
  Injection pause = of(Injection::Kind::kPause, "nav");
  pause.wall_s = 0.2;
  const pid_t child = ::fork();
  if (child == 0) {
    sent_by(pause, 10);
    ::_exit(7);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, WUNTRACED) == child);
  CHECK(WIFSTOPPED(status));
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 7);
}

TEST_CASE("injections survive as a fact") {
  std::vector<Injection> all;
  for (const auto kind : {Injection::Kind::kMute, Injection::Kind::kDrop, Injection::Kind::kDelay,
                          Injection::Kind::kCorrupt, Injection::Kind::kKill, Injection::Kind::kPause}) {
    all.push_back(of(kind));
  }
  all[1].share = 0.25;
  all[2].by = 40ms;
  all[3].field = "a.2", all[3].value = "nan";
  all[4].signal = 11;
  all[5].wall_s = 0.5;
  const auto read = injections_of(fact_of(all));
  REQUIRE(read.size() == 6);
  CHECK(fact_of(read) == fact_of(all));
  CHECK(read[1].share == 0.25);
  CHECK(read[3].value == "nan");
  CHECK(injections_of("").empty());
  CHECK_THROWS_AS(injections_of(R"([{"kind": "shout"}])"), std::invalid_argument);
}
