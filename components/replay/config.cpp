#include "components/replay/config.h"

#include "components/config/read_parameters.h"

namespace ensonify {

namespace {

std::string place_of(const ConfigNode* node) {
  if (!node) return "";
  const ConfigPlace& place = node->place;
  if (place.line == 0) return place.file;
  return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

}  // namespace

void ReplayedTopics::read(ConfigReader& from, const char* key) {
  const ConfigNode* topics = from.node(key);
  if (topics && topics->is_list()) {
    std::vector<std::string> names;
    from.required(key, names);
    assign(names.begin(), names.end());
    if (empty()) from.problem(key, "names no topic");
  } else if (topics) {
    std::string word;
    from.required(key, word);
    if (word != "all") from.problem(key, "\"" + word + "\" is not all or a list of topics");
  }
}

std::string ReplayedTopics::schema() {
  return R"({"anyOf": [{"const": "all"}, {"type": "array", "minItems": 1, "items": {"type": "string"}}]})";
}

void RenamedTopics::read(ConfigReader& from, const char* key) {
  if (auto rename = from.optional_section(key)) {
    for (const auto& entry : rename->node().entries) rename->required(entry.key, (*this)[entry.key]);
  }
}

ReplayConfig ReplayConfig::read(ConfigReader& from) {
  ReplayConfig config;
  read_parameters<ReplayParameters>(from, config);
  config.file_place = place_of(from.node("file"));
  config.topics_place = place_of(from.node("topics"));
  return config;
}

}  // namespace ensonify
