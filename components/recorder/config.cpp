#include "components/recorder/config.h"

#include "components/config/config_reader.h"
#include "components/runtime/topic_pattern.h"
#include "scenarios/scenario_file.h"

namespace ensonify {

namespace {

constexpr std::int64_t kMostSkipped = 1'000'000;

std::vector<RecordedTopics> read_topics(ConfigReader& from, const ConfigNode& node) {
  std::vector<RecordedTopics> topics;
  if (node.is_map()) {
    for (auto& [pattern, section] : from.named_sections("topics")) {
      RecordedTopics wanted{pattern, 1};
      section.optional("every", wanted.every, 1, kMostSkipped);
      topics.push_back(wanted);
    }
  } else if (node.is_list()) {
    std::vector<std::string> names;
    from.required("topics", names);
    for (const std::string& name : names) topics.push_back({name, 1});
  } else {
    std::string word;
    from.required("topics", word);
    if (word != "all") from.problem("topics", "\"" + word + "\" is not all, a list of topics or a map of topics");
    topics.push_back({"*", 1});
  }
  if (topics.empty()) from.problem("topics", "names no topic");
  return topics;
}

std::string text_of(const ConfigPlace& place) {
  if (place.line == 0) return place.file;
  return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

}  // namespace

RecorderConfig RecorderConfig::read(ConfigReader& from, const ScenarioHeader& scenario) {
  RecorderConfig config;
  from.optional("file", config.file);
  if (config.file.empty()) from.problem("file", "is empty");
  if (const ConfigNode* file = from.node("file")) config.file_place = text_of(file->place);
  if (const ConfigNode* topics = from.node("topics")) config.topics = read_topics(from, *topics);
  config.seed = scenario.seed;
  config.start_unix_ns = scenario.start_unix_ns;
  return config;
}

std::int64_t RecorderConfig::every(const std::string& topic) const {
  const RecordedTopics* best = nullptr;
  const auto rank = [](const RecordedTopics& t) {
    return is_pattern(t.pattern) ? t.pattern.size() : std::string::npos;
  };
  for (const RecordedTopics& candidate : topics) {
    if (topic_matches(candidate.pattern, topic) && (!best || rank(candidate) > rank(*best))) best = &candidate;
  }
  return best ? best->every : 1;
}

}  // namespace ensonify
