#include "components/recorder/config.h"

#include "components/config/parameter_schema.h"
#include "components/config/read_parameters.h"
#include "components/runtime/ports.h"
#include "scenarios/scenario_file.h"

namespace ensonify {
namespace {

constexpr std::int64_t kMostSkipped = 1'000'000;

struct KeptEvery {
  std::int64_t every = 1;

  static void parameters(auto& self, auto&& visit) {
    visit("every", "", in(1, kMostSkipped), "number of messages there are for one that is kept", self.every);
  }
};

std::string text_of(const ConfigPlace& place) {
  if (place.line == 0) return place.file;
  return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

}  // namespace

void TopicChoice::read(ConfigReader& from, const char* key) {
  const ConfigNode* node = from.node(key);
  if (node == nullptr) return;
  clear();
  if (node->is_map()) {
    for (auto& [pattern, section] : from.named_sections(key)) {
      KeptEvery kept;
      read_parameters(section, kept);
      push_back({pattern, kept.every});
    }
  } else if (node->is_list()) {
    std::vector<std::string> names;
    from.required(key, names);
    for (const std::string& name : names) push_back({name, 1});
  } else {
    std::string word;
    from.required(key, word);
    if (word != "all") from.problem(key, "\"" + word + "\" is not all, a list of topics or a map of topics");
    push_back({"*", 1});
  }
  if (empty()) from.problem(key, "names no topic");
}

std::string TopicChoice::schema() {
  return R"({"anyOf": [{"const": "all"}, {"type": "array", "minItems": 1, "items": {"type": "string"}},)"
         R"( {"type": "object", "minProperties": 1, "additionalProperties": )" +
         object_schema(parameters_of<KeptEvery>()) + "}]}";
}

RecorderConfig RecorderConfig::read(ConfigReader& from, const ScenarioHeader& scenario) {
  RecorderConfig config;
  read_parameters<RecorderParameters>(from, config);
  if (config.file.empty()) from.problem("file", "is empty");
  if (const ConfigNode* file = from.node("file")) config.file_place = text_of(file->place);
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
