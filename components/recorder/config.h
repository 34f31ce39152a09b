#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ensonify {

class ConfigReader;
struct ScenarioHeader;

/// Which messages are kept.
struct RecordedTopics {
  std::string pattern;     // a topic, "name/*" or "*"
  std::int64_t every = 1;  // of each topic that matches, messages 0, every, 2 every, ...

  bool operator==(const RecordedTopics&) const = default;
};

struct RecorderConfig {
  std::string file = "record.mcap";  // relative to the run's output folder
  std::vector<RecordedTopics> topics = {{"*", 1}};

  std::string file_place;  // where the user named it, for messages
  // From the scenario.
  std::uint64_t seed = 0;
  std::int64_t start_unix_ns = 0;

  static RecorderConfig read(ConfigReader& from, const ScenarioHeader& scenario);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const RecorderConfig& other) const { return file == other.file && topics == other.topics; }

  /// Number of messages of a topic per one that is kept. Of several patterns that match, the longest counts.
  std::int64_t every(const std::string& topic) const;
};

}  // namespace ensonify
