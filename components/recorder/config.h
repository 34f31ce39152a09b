#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/parameters.h"

namespace ensonify {

class ConfigReader;
struct ScenarioHeader;

/// Which messages are kept.
struct RecordedTopics {
  std::string pattern;     // a topic, "name/*" or "*"
  std::int64_t every = 1;  // of each topic that matches, messages 0, every, 2 every, ...

  bool operator==(const RecordedTopics&) const = default;
};

/// `all`, a list of topics and patterns, or a map from them to how often.
struct TopicChoice : std::vector<RecordedTopics> {
  using std::vector<RecordedTopics>::vector;
  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const { return ConfigNode::text("all"); }
  static std::string schema();
};

struct RecorderParameters {
  std::string file = "record.mcap";
  TopicChoice topics = {{"*", 1}};

  static void parameters(auto& self, auto&& visit) {
    visit("file", "", any(), "name of the record, relative to the run's output folder; folders are made", self.file);
    visit("topics", "", any(),
          "all, or a list ([bow/soundings, nav/*]), or a map ({\"*\": {}, bow/ping: {every: 100}}); the longest counts",
          self.topics);
  }
};

struct RecorderConfig : RecorderParameters {
  std::string file_place;  // where the user named it, for messages
  // From the scenario.
  std::uint64_t seed = 0;
  std::int64_t start_unix_ns = 0;

  static RecorderConfig read(ConfigReader& from, const ScenarioHeader& scenario);
  /// Number of messages of a topic per one that is kept. Of several patterns that match, the longest counts.
  std::int64_t every(const std::string& topic) const;
};

}  // namespace ensonify
