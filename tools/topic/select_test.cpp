#include "tools/topic/select.h"

#include <catch2/catch.hpp>

#include "components/errors/exit_error.h"
#include "tools/topic/pretty.h"

namespace ensonify::topic_tool {

namespace {

RunRegistry bay() {
  RunRegistry registry;
  for (const char* name : {"auv/pose", "bow/ping", "bow/soundings"}) {
    registry.topics.emplace_back().name = name;
  }
  return registry;
}

std::vector<std::string> names(const std::vector<TopicEntry>& topics) {
  std::vector<std::string> all;
  for (const TopicEntry& topic : topics) all.push_back(topic.name);
  return all;
}

}  // namespace

TEST_CASE("topics are chosen by name and pattern, each once, in the registry's order") {
  using Names = std::vector<std::string>;
  CHECK(names(select(bay(), {"bow/ping"})) == Names{"bow/ping"});
  CHECK(names(select(bay(), {"bow/*"})) == Names{"bow/ping", "bow/soundings"});
  CHECK(names(select(bay(), {"bow/ping", "*"})) == Names{"auv/pose", "bow/ping", "bow/soundings"});
}

TEST_CASE("a misspelt topic is answered with the nearest one, or with all") {
  CHECK_THROWS_WITH(select(bay(), {"bow/pign"}), "bow/pign: no such topic; did you mean bow/ping?");
  CHECK_THROWS_WITH(select(bay(), {"xyz"}), "xyz: no such topic; there are auv/pose, bow/ping, bow/soundings");
  CHECK_THROWS_AS(select(bay(), {"stern/*"}), UserError);
}

TEST_CASE("sizes and rates are written with units") {
  CHECK(bytes_text(512) == "512 B");
  CHECK(bytes_text(17'000) == "17 kB");
  CHECK(bytes_text(4'194'304) == "4.19 MB");
  CHECK(rate_text({30000, 1001}) == "29.97 Hz");
  CHECK(rate_text({0, 1}) == "at most 10 Hz on average");
}

}  // namespace ensonify::topic_tool
