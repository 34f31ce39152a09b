#include "tools/graph/picture.h"

#include <catch2/catch.hpp>

#include "tools/graph/picture_text.h"

namespace ensonify::graph_tool {

namespace {

/// A boat with a pilot that steers it over a delayed edge, and a head.
std::vector<Declaration> boat_and_pilot() {
  const OutPort health{"health", "health/1", 65536, {1, 1}};
  return {{"boat",
           "vehicle",
           {{"pose", "pose/1", 512, {100, 1}}, health},
           {{"command", "guidance/1", 100_ms, false, {}, 0}},
           false,
           {}},
          {"pilot",
           "pilot",
           {{"command", "guidance/1", 4096, {10, 1}}, health},
           {{"pose", "pose/1", 0_s, false, {}, 0}},
           false,
           {}},
          {"bow",
           "multibeam",
           {{"ping", "ping/1", 2'100'000, {0, 1}}, health},
           {{"pose", "pose/1", 0_s, false, {}, 0}},
           false,
           {}}};
}

Picture picture() {
  const auto processes = boat_and_pilot();
  const Graph graph = wire(processes, {});
  REQUIRE(graph.problems.empty());
  return without_health(picture_of(graph, processes));
}

}  // namespace

TEST_CASE("wiring as text lists each process's ports with rates, sizes and delays") {
  CHECK(to_text(picture()) ==
        "boat (vehicle)\n"
        "  reads pilot/command as command, delayed 100 ms\n"
        "  boat/pose      pose/1       100 Hz    512 B  -> pilot.pose, bow.pose\n"
        "pilot (pilot)\n"
        "  reads boat/pose as pose\n"
        "  pilot/command  guidance/1    10 Hz     4 kB  -> boat.command (delayed 100 ms)\n"
        "bow (multibeam)\n"
        "  reads boat/pose as pose\n"
        "  bow/ping       ping/1                2.1 MB  -> nobody\n");
}

TEST_CASE("the wiring for Graphviz: an arrow per pair of processes, delayed ones dashed") {
  const std::string dot = to_dot(picture());
  CHECK(dot.find("  \"boat\" [label=\"boat\\nvehicle\"];\n") != std::string::npos);
  CHECK(dot.find("  \"pilot\" [label=\"pilot\"];\n") != std::string::npos);
  CHECK(dot.find("  \"boat\" -> \"pilot\" [label=\"pose  100 Hz\"];\n") != std::string::npos);
  CHECK(dot.find("  \"pilot\" -> \"boat\" [label=\"command  10 Hz\\ndelayed 100 ms\", style=dashed];\n") !=
        std::string::npos);
  CHECK(dot.starts_with("digraph ensonify {\n"));
  CHECK(dot.ends_with("}\n"));
}

TEST_CASE("a live run's registry gives the same picture as its launch file") {
  const Picture from_launch = picture();
  RunRegistry registry;
  registry.processes = {{"boat", "vehicle"}, {"pilot", "pilot"}, {"bow", "multibeam"}};
  registry.topics = {
      {"boat/pose",
       "pose/1",
       "boat",
       "vehicle",
       512,
       {100, 1},
       "",
       false,
       7,
       {{"pilot", "pose", 0_s}, {"bow", "pose", 0_s}}},
      {"pilot/command", "guidance/1", "pilot", "pilot", 4096, {10, 1}, "", false, 1, {{"boat", "command", 100_ms}}},
      {"bow/ping", "ping/1", "bow", "multibeam", 2'100'000, {0, 1}, "", false, 0, {}}};
  CHECK(to_text(picture_of(registry)) == to_text(from_launch));
  CHECK(to_dot(picture_of(registry)) == to_dot(from_launch));
}

TEST_CASE("health topics are left out unless somebody reads them") {
  auto processes = boat_and_pilot();
  processes.push_back({"console", "console", {}, {{"health", "health/1", 0_s, false, {}, 0}}, false, {}});
  const Graph graph = wire(processes, {{"console.health", "bow/health", SimTime{-1}, "x.yaml:1:1"}});
  REQUIRE(graph.problems.empty());
  const Picture all = picture_of(graph, processes);
  CHECK(all.topics.size() == 6);
  const Picture few = without_health(all);
  REQUIRE(few.topics.size() == 4);
  CHECK(few.topics[3].name == "bow/health");
  CHECK(few.edges.back().topic == 3);
}

TEST_CASE("a process whose ports are not known is drawn and said to be so") {
  Picture p = picture();
  p.processes.push_back({"agent", "", false});
  CHECK(to_text(p).ends_with("agent: its ports are not known before it runs\n"));
  CHECK(to_dot(p).find("\"agent\" [label=\"agent\", style=\"rounded,dashed\"]") != std::string::npos);
  CHECK(to_json(p).find(R"({"name":"agent","component":"","ports_known":false})") != std::string::npos);
}

}  // namespace ensonify::graph_tool
