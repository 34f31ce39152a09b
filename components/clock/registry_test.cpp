#include "components/clock/registry.h"

#include <catch2/catch.hpp>

#include "components/runtime/declared.h"
#include "messages/declarations.h"

using namespace ensonify;

namespace {

Launch launch_of(std::vector<std::string> names) {
  Launch launch;
  for (const std::string& name : names) {
    ProcessSpec process;
    process.name = name;
    launch.processes.push_back(process);
  }
  return launch;
}

protocol::Hello hello_of(const std::string& name, std::vector<OutPort> outs, std::vector<InPort> ins) {
  protocol::Hello hello;
  hello.declaration = {name, "stub", std::move(outs), std::move(ins), false};
  hello.resets = true;
  hello.sync_endpoint = hello.live_endpoint = "ipc://" + name;
  return hello;
}

}  // namespace

TEST_CASE("an edge is proven by its own publisher only, whoever else has seen the token") {
  clock::Registry registry(launch_of({"a", "b", "c"}));
  CHECK(registry.join("a", hello_of("a", {{"x", "x/1", 100, {1, 1}}}, {})).empty());
  CHECK(registry.join("b", hello_of("b", {{"y", "y/1", 100, {1, 1}}}, {})).empty());
  CHECK(registry.missing() == std::vector<std::string>{"c"});
  CHECK(registry
            .join("c",
                  hello_of("c", {}, {{"x", "x/1", SimTime{0}, false, {}, 0}, {"y", "y/1", SimTime{0}, false, {}, 0}}))
            .empty());
  REQUIRE(registry.check().empty());
  const auto welcome = registry.welcome(2);
  REQUIRE(welcome.ins.size() == 2);
  registry.proven("b", welcome.ins[0].token);  // the token of a's edge, seen by b
  CHECK(registry.unproven().size() == 2);
  registry.proven("a", welcome.ins[0].token);
  registry.proven("b", welcome.ins[1].token);
  CHECK(registry.ready());
}

TEST_CASE("a stranger, a double and a process under another's name are refused") {
  clock::Registry registry(launch_of({"a"}));
  CHECK(registry.join("z", hello_of("z", {}, {})) == "z: the launch file names no such process");
  CHECK(registry.join("z", hello_of("a", {}, {})) == "hello of a came from z");
  CHECK(registry.join("a", hello_of("a", {}, {})).empty());
  CHECK(registry.join("a", hello_of("a", {}, {})) == "a: has joined already");
}

TEST_CASE("a port for viewers is no topic of the graph: it cannot be wired or recorded") {
  clock::Registry registry(launch_of({"bow", "recorder", "agent"}));
  auto bow = hello_of("bow", {{"ping", "ping/1", 100, {1, 1}}}, {});
  bow.declaration.lives = {{"view", "view/1", 100}};
  CHECK(registry.join("bow", bow).empty());
  CHECK(registry.join("recorder", hello_of("recorder", {}, {{"all", "*", SimTime{0}, true, {"*"}, 0}})).empty());
  CHECK(registry.join("agent", hello_of("agent", {}, {{"view", "view/1", SimTime{0}, true, {}, 0}})).empty());
  REQUIRE(registry.check().empty());
  CHECK(registry.graph().topics.size() == 1);
  CHECK(registry.welcome(0).outs.size() == 1);
  REQUIRE(registry.welcome(1).ins.size() == 1);
  CHECK(registry.welcome(1).ins[0].feed.topic == "bow/ping");
  CHECK(registry.welcome(2).ins.empty());
}

TEST_CASE("everybody learns what each process declares") {
  clock::Registry registry(launch_of({"bow", "pager"}));
  auto bow = hello_of("bow", {}, {});
  msg::HeadDeclaration head;
  head.reach_m = 151.5;
  head.channels = {{"low", {{100e3, 0.0}}, {{"mode", 0.0, 0.0, false, {"bathymetry"}}}}};
  bow.declaration.declares = {{msg::HeadDeclaration::kType, msg::to_value(head)}};
  CHECK(registry.join("bow", bow).empty());
  CHECK(registry.join("pager", hello_of("pager", {}, {})).empty());
  REQUIRE(registry.check().empty());
  const auto heads = declared<msg::HeadDeclaration>(registry.welcome(1).facts);
  REQUIRE(heads.size() == 1);
  CHECK(msg::to_value(heads.at("bow")) == msg::to_value(head));
}

TEST_CASE("in a later epoch the same processes join again; time starts when each has read its welcome") {
  const Launch launch = launch_of({"a", "b"});
  clock::Registry registry(launch);
  auto a = hello_of("a", {{"x", "x/1", 100, {1, 1}}}, {});
  auto b = hello_of("b", {}, {{"x", "x/1", SimTime{0}, false, {}, 0}});
  CHECK(registry.join("a", a).empty());
  CHECK(registry.join("b", b).empty());
  REQUIRE(registry.check().empty());
  registry.proven("a", registry.welcome(1).ins[0].token);
  REQUIRE(registry.ready());
  CHECK(registry.fixed().empty());

  registry.begin(launch, 2);
  CHECK(registry.missing() == std::vector<std::string>{"a", "b"});
  CHECK(registry.participant("a") == 0);  // it may still say that it has failed
  CHECK(registry.join("a", a) == "a: joins epoch 1, the run's is 2");
  a.epoch = b.epoch = 2;
  b.resets = false;
  CHECK(registry.join("a", a).empty());
  CHECK(registry.join("a", a) == "a: has joined already");
  CHECK(registry.join("b", b).empty());
  CHECK(registry.fixed() == std::vector<std::string>{"b"});
  REQUIRE(registry.check().empty());
  CHECK(registry.welcome(1).epoch == 2);
  CHECK(registry.unproven() == std::vector<std::string>{"a", "b"});
  registry.is_ready(0);
  CHECK_FALSE(registry.ready());
  registry.is_ready(1);
  CHECK(registry.ready());

  registry.begin(launch, 3);
  a.epoch = b.epoch = 3;
  a.declaration.outs.push_back({"y", "y/1", 100, {1, 1}});
  CHECK(registry.join("a", a).empty());
  CHECK(registry.join("b", b).empty());
  CHECK(registry.check() == std::vector<std::string>{"a/y of type y/1: is new; only a new launch can have it"});
}
