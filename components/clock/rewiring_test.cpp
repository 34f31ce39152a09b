#include "components/clock/rewiring.h"

#include <catch2/catch.hpp>

using namespace ensonify;

namespace {

std::vector<Declaration> processes(std::size_t max_bytes = 100, Rate rate = {10, 1}, const std::string& port = "ping") {
  return {{"bow", "stub", {{port, "ping/1", max_bytes, rate}}, {}, false},
          {"agent", "stub", {}, {{"pings", "ping/1", SimTime{0}, true, {}, 0}}, false}};
}

std::vector<std::string> change_to(const std::vector<Declaration>& now) {
  return clock::rewired(wire(processes(), {}), processes(), wire(now, {}), now);
}

}  // namespace

TEST_CASE("another rate or size fits the same lines, up to what they carry") {
  CHECK(change_to(processes()).empty());
  CHECK(change_to(processes(100, {20, 1})).empty());
  CHECK(change_to(processes(1 << 24)).empty());
  CHECK(change_to(processes((1 << 24) + 1)) ==
        std::vector<std::string>{
            "bow/ping: up to 16777217 bytes, where this launch carries 16777216; only a new launch can have it"});
  const auto large = processes(1 << 25);
  CHECK(clock::rewired(wire(large, {}), large, wire(large, {}), large).empty());
}

TEST_CASE("what is published and who reads it must be as in the first epoch, and each change is named") {
  CHECK(change_to(processes(100, {10, 1}, "image")) ==
        std::vector<std::string>{"bow/image of type ping/1: is new; only a new launch can have it",
                                 "bow/ping of type ping/1: is gone; only a new launch can do without",
                                 "bow/image read by agent.pings: is new; only a new launch can have it",
                                 "bow/ping read by agent.pings: is gone; only a new launch can do without"});
  auto deaf = processes();
  deaf[1].ins.clear();
  CHECK(change_to(deaf) ==
        std::vector<std::string>{"bow/ping read by agent.pings: is gone; only a new launch can do without"});
}
