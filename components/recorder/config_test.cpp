#include "components/recorder/config.h"

#include <catch2/catch.hpp>

#include "scenarios/scenario_file.h"

using namespace ensonify;

namespace {

RecorderConfig read(const std::string& yaml) {
  auto from = ConfigReader::from_text(yaml, "r.yaml");
  RecorderConfig config = RecorderConfig::read(from, ScenarioHeader{});
  from.finish();
  return config;
}

std::string problem(const std::string& yaml) {
  try {
    read(yaml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("topics are all, a list or a map") {
  CHECK(read("topics: all").topics == std::vector<RecordedTopics>{{"*", 1}});
  CHECK(read("topics: [bow/ping, nav/*]").topics == std::vector<RecordedTopics>{{"bow/ping", 1}, {"nav/*", 1}});
  CHECK(read("topics: {'*': {}, bow/ping: {every: 100}}").topics ==
        std::vector<RecordedTopics>{{"*", 1}, {"bow/ping", 100}});
  CHECK(problem("topics: some") == "r.yaml:1:9: topics: \"some\" is not all, a list of topics or a map of topics");
  CHECK(problem("topics: []") == "r.yaml:1:9: topics: names no topic");
  CHECK(problem("topics: {bow/ping: {every: 0}}") == "r.yaml:1:28: topics.bow/ping.every: 0 is outside [1, 1000000]");
  CHECK(problem("topics: {bow/ping: {evry: 2}}").find("is not a known key") != std::string::npos);
  CHECK(problem("file: ''") == "r.yaml:1:7: file: is empty");
}

TEST_CASE("of several patterns the longest counts, and a name before any pattern") {
  const RecorderConfig config =
      read("topics: {'*': {}, 'bow/*': {every: 5}, bow/ping: {every: 100}, 'bow/ping*': {every: 7}}");
  CHECK(config.every("nav/attitude") == 1);
  CHECK(config.every("bow/soundings") == 5);
  CHECK(config.every("bow/ping") == 100);
  CHECK(config.every("bow/pings") == 7);
}
