#include "components/replay/config.h"

#include "components/config/config_reader.h"

namespace ensonify {

namespace {

std::string place_of(const ConfigNode* node) {
  if (!node) return "";
  const ConfigPlace& place = node->place;
  if (place.line == 0) return place.file;
  return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

}  // namespace

ReplayConfig ReplayConfig::read(ConfigReader& from) {
  ReplayConfig config;
  from.required_path("file", config.file);
  from.optional("finish", config.finish);
  config.file_place = place_of(from.node("file"));
  config.topics_place = place_of(from.node("topics"));

  const ConfigNode* topics = from.node("topics");
  if (topics && topics->is_list()) {
    from.required("topics", config.topics);
    if (config.topics.empty()) from.problem("topics", "names no topic");
  } else if (topics) {
    std::string word;
    from.required("topics", word);
    if (word != "all") from.problem("topics", "\"" + word + "\" is not all or a list of topics");
  }

  if (auto rename = from.optional_section("rename")) {
    for (const auto& entry : rename->node().entries) rename->required(entry.key, config.rename[entry.key]);
  }
  return config;
}

}  // namespace ensonify
