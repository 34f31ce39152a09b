#include "components/runtime/host.h"

#include <stdlib.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>

#include "messages/motion.h"

using namespace ensonify;

namespace {

/// A private folder for sockets, removed at the end.
struct Folder {
  Folder() {
    char name[] = "/tmp/ensonify-host-XXXXXX";
    path = mkdtemp(name);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string path;
};

/// Publishes ten times a second; throws at the event at `throws_at`.
struct Speaker {
  struct Config {
    SimTime throws_at = kNever;
  };
  Speaker(const Config& config, Ports& ports)
      : config_(config), out_(ports.out<msg::Guidance>("word", {.rate = {10, 1}})) {}
  SimTime step(SimTime now) {
    if (now == config_.throws_at) throw std::runtime_error("told to throw");
    out_.send({now.count(), 0.0, 1.0});
    return now + SimTime(std::chrono::milliseconds(100));
  }
  Config config_;
  Ports::Out<msg::Guidance> out_;
};

/// Notes at each of its events, ten a second, how many messages have come by then.
struct Listener {
  struct Config {
    std::vector<int>* seen = nullptr;
  };
  Listener(const Config& config, Ports& ports) : config_(config) {
    ports.in<msg::Guidance>("word", [this](const msg::Guidance&) { ++count_; });
  }
  SimTime step(SimTime now) {
    config_.seen->push_back(count_);
    return now + SimTime(std::chrono::milliseconds(100));
  }
  Config config_;
  int count_ = 0;
};

template <class Node>
OpenSession session_of(const std::string& name, const typename Node::Config& config) {
  return [=](const EpochOptions&) {
    return std::make_unique<Session>("test", name, ".",
                                     [&](Ports& ports) { return std::make_unique<NodeHolder<Node>>(config, ports); });
  };
}

/// What the clock does with a speaker, `a`, and a listener, `b`.
struct Run {
  explicit Run(SimTime throws_at = kNever) {
    host.add(session_of<Speaker>("a", {throws_at}));
    host.add(session_of<Listener>("b", {&seen}));
    host.join();
    for (int i = 0; i < 2; ++i) {
      const auto hello = protocol::read_hello(next().text);
      declared.insert_or_assign(hello.declaration.process, hello);
    }
  }

  bus::ControlPlane::Message next() {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (std::chrono::steady_clock::now() < deadline) {
      if (auto message = host.wait(deadline)) return *message;
    }
    FAIL("nobody says anything");
    return {};
  }

  void welcome(std::uint32_t epoch = 1) {
    protocol::Welcome to_a, to_b;
    to_a.epoch = to_b.epoch = epoch;
    to_a.outs = {{"a/word", 0}, {"a/health", 1}};
    to_a.out_tokens = {{"e0"}, {}};
    to_b.rank = 1;
    to_b.outs = {{"b/health", 2}};
    to_b.out_tokens = {{}};
    Feed feed{0, "a/word", 0, "guidance/1", "a", 0, SimTime{0}};
    feed.max_bytes = 4096;
    feed.rate = {10, 1};
    to_b.ins = {{feed, declared.at("a").sync_endpoint, "e0"}};
    host.send("a", protocol::encode(to_a, declared.at("a").declaration));
    host.send("b", protocol::encode(to_b, declared.at("b").declaration));
  }

  void grant(const std::string& to, int until_ms, protocol::TopicCounts inputs = {}, std::uint32_t epoch = 1) {
    host.send(to, protocol::encode(protocol::Grant{epoch, std::chrono::milliseconds(until_ms), std::move(inputs)}));
  }

  Folder folder;
  std::vector<int> seen;
  bus::Router router{{.run_dir = folder.path}};
  Host host{router, {.run_dir = folder.path}};
  std::map<std::string, protocol::Hello> declared;
};

}  // namespace

TEST_CASE("members of one program get each other's messages without a proof by sockets or a wait") {
  Run run;
  run.welcome();
  const auto proven = run.next();
  CHECK(proven.from == "a");
  CHECK(protocol::read_tokens(proven.text) == std::vector<std::string>{"e0"});
  run.grant("a", 250);
  const auto spoken = protocol::read_done(run.next().text);
  REQUIRE(spoken);
  CHECK(spoken->next == std::chrono::milliseconds(300));
  CHECK(spoken->outputs[0] == std::pair<std::uint32_t, std::uint64_t>{0, 3});
  run.grant("b", 250, {{0, 3}});
  REQUIRE(protocol::read_done(run.next().text));
  CHECK(run.seen == std::vector<int>{1, 2, 3});
}

TEST_CASE("members begin another epoch with nothing of the one before") {
  Run run;
  run.welcome();
  run.next();
  run.grant("a", 250);
  run.next();
  for (const char* name : {"a", "b"}) run.host.send(name, protocol::encode(protocol::Begin{2, {}, ""}));
  CHECK(protocol::read_hello(run.next().text).epoch == 2);
  CHECK(protocol::read_hello(run.next().text).epoch == 2);
  run.welcome(2);
  std::vector<std::string> said;
  for (int i = 0; i < 3; ++i) said.push_back(protocol::kind_of(run.next().text));
  CHECK(std::ranges::count(said, "ready") == 2);
  run.grant("a", 50, {}, 2);
  run.next();
  run.grant("b", 50, {{0, 1}}, 2);
  run.next();
  CHECK(run.seen == std::vector<int>{1});
}

TEST_CASE("a member that throws fails in its own name, and is asked nothing more") {
  Run run(std::chrono::milliseconds(100));
  run.welcome();
  run.next();
  run.grant("a", 250);
  const auto failed = run.next();
  CHECK(failed.from == "a");
  const auto why = protocol::read_failed(failed.text);
  CHECK(why.code == kExitDied);
  CHECK(why.message == "told to throw");
  run.grant("a", 250);
  CHECK_FALSE(run.host.wait(std::chrono::steady_clock::now() + std::chrono::milliseconds(20)));
}

TEST_CASE("who takes part from outside is heard, and gets what members publish") {
  Run run;
  run.welcome();
  run.next();
  bus::Link outside("c", run.router.endpoint(), {.run_dir = run.folder.path}, 16);
  outside.subscribe({{"a/word", 0, "guidance/1", run.declared.at("a").sync_endpoint, "e1", 4096, "a", 0, {10, 1}}}, 1);
  const auto proven = run.next();
  CHECK(proven.from == "a");
  CHECK(protocol::read_tokens(proven.text) == std::vector<std::string>{"e1"});
  outside.send_control("hello there");
  const auto hello = run.next();
  CHECK((hello.from == "c" && hello.text == "hello there"));
  CHECK(run.host.send("c", "and there"));
  const auto answer = outside.wait();
  CHECK(answer.control == "and there");
  run.grant("a", 250);
  REQUIRE(protocol::read_done(run.next().text));
  CHECK(outside.wait_arrived({{0, 3}}, std::chrono::seconds(20)) == bus::Link::Arrived::kAll);
}

TEST_CASE("a grant that counts what has not come from outside waits, while others are heard") {
  Folder folder;
  std::vector<int> seen;
  bus::Router router({.run_dir = folder.path});
  Host host(router, {.run_dir = folder.path});
  host.add(session_of<Listener>("b", {&seen}));
  host.join();
  const auto hello = protocol::read_hello(host.wait({})->text);
  bus::Link outside("c", router.endpoint(), {.run_dir = folder.path}, 16);
  protocol::Welcome welcome;
  welcome.outs = {{"b/health", 1}};
  welcome.out_tokens = {{}};
  Feed feed{0, "c/word", 0, "guidance/1", "c", 1, SimTime{0}};
  feed.max_bytes = 4096;
  feed.rate = {10, 1};
  welcome.ins = {{feed, outside.sync_endpoint(), "e0"}};
  host.send("b", protocol::encode(welcome, hello.declaration));
  host.send("b", protocol::encode(protocol::Grant{1, SimTime{0}, {{0, 1}}}));
  CHECK_FALSE(host.wait(std::chrono::steady_clock::now() + std::chrono::milliseconds(50)));
  CHECK(seen.empty());
  CHECK(outside.wait().kind == bus::Link::Event::kTokens);
  outside.send_control("meanwhile");
  const auto until = [&](const std::string& from) {
    while (true) {
      const auto message = host.wait(std::chrono::steady_clock::now() + std::chrono::seconds(20));
      if (message) return message->from == from;
    }
  };
  CHECK(until("c"));
  CHECK(seen.empty());
  msg::Packet packet;
  packet.topic = "c/word";
  packet.body = msg::encode(msg::Guidance{0, 0.0, 1.0});
  packet.envelope.epoch = 1;
  packet.envelope.publisher = 1;
  packet.envelope.type_hash = msg::type_hash("guidance/1");
  packet.envelope.frame_count = static_cast<std::uint32_t>(msg::kFirstArrayFrame);
  outside.publish(packet);
  outside.flush();
  CHECK(until("b"));
  CHECK(seen == std::vector<int>{1});
}
