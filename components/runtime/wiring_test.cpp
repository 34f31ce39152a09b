#include "components/runtime/wiring.h"

#include <catch2/catch.hpp>

using namespace ensonify;

namespace {

Declaration process(const std::string& name, std::vector<OutPort> outs, std::vector<InPort> ins) {
  return {name, name, std::move(outs), std::move(ins), false};
}
OutPort out(const std::string& port, const std::string& type) { return {port, type, 4096, {10, 1}}; }
InPort in(const std::string& port, const std::string& type, SimTime delay = SimTime{0}) {
  return {port, type, delay, false, {}, 0};
}

std::string only_problem(const std::vector<Declaration>& processes, const std::vector<WireRule>& rules = {}) {
  const Graph graph = wire(processes, rules);
  REQUIRE(graph.problems.size() == 1);
  return graph.problems[0];
}

const std::vector<Declaration> kLoop = {process("auv", {out("pose", "pose/1")}, {in("command", "guidance/1", 100_ms)}),
                                        process("pilot", {out("command", "guidance/1")}, {in("pose", "pose/1")})};

}  // namespace

TEST_CASE("an input finds the only publisher of its type") {
  const Graph graph = wire(kLoop, {});
  CHECK(graph.problems.empty());
  REQUIRE(graph.edges.size() == 2);
  CHECK(graph.topics[graph.edges[0].topic].name == "pilot/command");
  CHECK(graph.edges[0].delay == 100_ms);
}

TEST_CASE("two publishers of a type need a rule") {
  auto processes = kLoop;
  processes.push_back(process("agent", {out("command", "guidance/1")}, {}));
  CHECK(only_problem(processes) ==
        "auv.command: several publishers offer guidance/1 (pilot/command, agent/command); name one under wiring:");
  CHECK(wire(processes, {{"auv.command", "agent/command", SimTime{-1}, "x.yaml:3:1"}}).problems.empty());
}

TEST_CASE("an output that is called after an input and a process is for that one alone") {
  std::vector<Declaration> processes;
  for (const char* name : {"bow", "side", "stern"}) {
    InPort settings = in("settings", "sonar_settings/1", 100_ms);
    settings.optional = true;
    processes.push_back(process(name, {}, {settings}));
  }
  processes.push_back(
      process("pilot", {out("settings_bow", "sonar_settings/1"), out("settings_stern", "sonar_settings/1")}, {}));
  const Graph graph = wire(processes, {});
  CHECK(graph.problems.empty());
  REQUIRE(graph.edges.size() == 2);  // the side head receives nobody
  CHECK(graph.topics[graph.edges[0].topic].name == "pilot/settings_bow");
  CHECK(graph.edges[0].to == 0);
  CHECK(graph.topics[graph.edges[1].topic].name == "pilot/settings_stern");
  CHECK(graph.edges[1].to == 2);
  CHECK(wire(processes, {{"side.settings", "pilot/settings_bow", SimTime{-1}, "x.yaml:3:1"}}).edges.size() == 3);
}

TEST_CASE("a misspelt topic or input is named with the nearest one") {
  CHECK(only_problem(kLoop, {{"auv.command", "pilot/comand", SimTime{-1}, "x.yaml:3:1"}}) ==
        "x.yaml:3:1: wiring.auv.command: no process publishes pilot/comand (did you mean pilot/command?)");
  CHECK(only_problem(kLoop, {{"auv.comand", "pilot/command", SimTime{-1}, "x.yaml:3:1"}}) ==
        "x.yaml:3:1: wiring.auv.comand: no process has this input (did you mean auv.command?)");
}

TEST_CASE("a wrong type, a missing publisher and a shortened delay are refused") {
  CHECK(only_problem(kLoop, {{"auv.command", "auv/pose", SimTime{-1}, "x.yaml:3:1"}}) ==
        "x.yaml:3:1: wiring.auv.command: auv/pose is pose/1, the input takes guidance/1");
  CHECK(only_problem({process("head", {}, {in("pose", "pose/1")})}) ==
        "head.pose: no publisher offers pose/1; allowed: a launch with one");
  CHECK(
      only_problem(kLoop, {{"auv.command", "pilot/command", 50_ms, "x.yaml:3:1"}}) ==
      "x.yaml:3:1: wiring.auv.command: delay_ms 50 is shorter than the port's 100; a launch file may only lengthen it");
}

TEST_CASE("a publisher that is slower than an input needs is refused") {
  Declaration nav = process("nav", {}, {in("pose", "pose/1")});
  nav.ins[0].least = {200, 1};
  const auto with_rate = [&](Rate rate) {
    return std::vector{process("auv", {{"pose", "pose/1", 4096, rate}}, {}), nav};
  };
  CHECK(only_problem(with_rate({100, 1})) == "nav.pose: needs at least 200 Hz, and auv/pose has 100 Hz");
  CHECK(wire(with_rate({200, 1}), {}).problems.empty());
  CHECK(wire(with_rate({}), {}).problems.empty());  // declares none
}

TEST_CASE("another major version of a type is another type") {
  CHECK(only_problem({process("auv", {out("pose", "x/2")}, {}), process("head", {}, {in("pose", "x/1")})}) ==
        "head.pose: no publisher offers x/1; allowed: a launch with one");
}

TEST_CASE("every cycle needs a delayed edge, and the one without is named") {
  auto processes = kLoop;
  processes[0].ins[0].delay = SimTime{0};
  CHECK(only_problem(processes) ==
        "wiring: auv -> pilot -> auv: a cycle without a delayed edge; give one of its inputs a delay_ms");
  CHECK(wire(processes, {{"auv.command", "pilot/command", 20_ms, "x.yaml:3:1"}}).problems.empty());
}

TEST_CASE("a pattern takes all topics but its owner's; an unpublished name is refused") {
  auto processes = kLoop;
  processes.push_back(
      {"recorder", "recorder", {out("health", "health/1")}, {{"all", "*", SimTime{0}, true, {"*"}, 0}}, false});
  const Graph graph = wire(processes, {});
  CHECK(graph.problems.empty());
  CHECK(feeds_of(graph, processes, 2).size() == 2);
  processes[2].ins[0].topics = {"auv/poze"};
  CHECK(only_problem(processes) == "recorder.all: no process publishes auv/poze (did you mean auv/pose?)");
  CHECK(wire(processes, {}, {{"recorder", "x.yaml:7:3"}}).problems.front() ==
        "x.yaml:7:3: recorder.all: no process publishes auv/poze (did you mean auv/pose?)");
}

TEST_CASE("a hundred thousand wrong keys are each named once") {  // time that grows with their square would not end
  const std::vector<Declaration> one = {process("auv", {out("pose", "pose/1")}, {})};
  std::vector<WireRule> rules;
  for (int i = 0; i < 100'000; ++i) {
    rules.push_back({"auv.in" + std::to_string(i), "auv/pose", SimTime{-1}, "x.yaml:" + std::to_string(i)});
  }
  CHECK(wire(one, rules).problems.size() == rules.size());
}

TEST_CASE("an input of one type takes it from every publisher that it lists") {
  std::vector<Declaration> heads = {process("bow", {out("transmit", "transmit/1"), out("ping", "ping/1")}, {}),
                                    process("side", {out("transmit", "transmit/1")}, {}),
                                    process("down", {out("transmit", "transmit/1")}, {})};
  for (std::size_t i = 0; i < 2; ++i) {  // they receive each other, and down receives nobody
    heads[i].ins = {{"transmits", "transmit/1", 20_ms, false, {i == 0 ? "side/transmit" : "bow/transmit"}, 0}};
  }
  heads[0].ins[0].topics.push_back("down/transmit");
  const Graph graph = wire(heads, {});
  CHECK(graph.problems.empty());
  const auto feeds = feeds_of(graph, heads, 0);
  REQUIRE(feeds.size() == 2);
  CHECK(feeds[0].publisher == "side");
  CHECK(feeds[1].publisher == "down");
  CHECK(feeds[1].delay == 20_ms);

  heads[1].ins[0].topics = {"*"};  // whatever is of the type, but its own
  CHECK(feeds_of(wire(heads, {}), heads, 1).size() == 2);
  heads[1].ins[0].topics = {"bow/ping"};
  CHECK(only_problem(heads) == "side.transmits: bow/ping is ping/1, the input takes transmit/1");
}

TEST_CASE("a sync queue holds two messages and a window of each topic") {
  const Declaration p = process("auv", {{"pose", "pose/1", 4096, {100, 1}}, {"health", "health/1", 4096, {1, 1}}}, {});
  CHECK(queue_length(p, 1_s) == 2 + 100 + 2 + 1);
}

TEST_CASE("two recorders record everything but each other, and wait for nobody in a circle") {
  const auto recorder = [](const std::string& name) {
    return Declaration{
        name, "recorder", {out("health", "health/1")}, {{"all", "*", SimTime{0}, true, {"*"}, 0}}, false};
  };
  const Graph graph = wire({{"auv", "vehicle", {out("pose", "pose/1")}, {}, false}, recorder("a"), recorder("b")}, {});
  CHECK(graph.problems.empty());
  REQUIRE(graph.edges.size() == 2);
  for (const Graph::Edge& edge : graph.edges) CHECK(graph.topics[edge.topic].name == "auv/pose");
}

TEST_CASE("a type of ours in an unknown version is a mistake, whether or not anybody takes it") {
  auto processes = kLoop;
  processes.push_back(process("agent", {out("mark", "mark/9")}, {}));
  CHECK(only_problem(processes) == "agent/mark: type mark/9 is of an unknown version; known: mark/1");
  processes.back() = process("agent", {}, {in("pose", "pose/2")});
  processes.back().ins[0].optional = true;
  CHECK(only_problem(processes) == "agent/pose: type pose/2 is of an unknown version; known: pose/1");
  processes.back() = process("agent", {out("mark", "my_mark/9")}, {});
  CHECK(wire(processes, {}).problems.empty());
}
