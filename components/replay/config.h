#pragma once

#include <map>
#include <string>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/parameters.h"

namespace ensonify {

class ConfigReader;

/// `all`, or a list of names and patterns.
struct ReplayedTopics : std::vector<std::string> {
  using std::vector<std::string>::vector;
  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const { return ConfigNode::text("all"); }
  static std::string schema();
};

/// Recorded topic to port.
struct RenamedTopics : std::map<std::string, std::string> {
  using std::map<std::string, std::string>::map;
  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const { return ConfigNode::map(); }
  static std::string schema() { return R"({"type": "object", "additionalProperties": {"type": "string"}})"; }
};

struct ReplayParameters {
  std::string file;
  ReplayedTopics topics = {"*"};
  RenamedTopics rename;
  bool finish = false;

  static void parameters(auto& self, auto&& visit) {
    visit("file", "", must(path()), "a record; a truncated one is played to its last whole chunk, and health says so",
          self.file);
    visit("topics", "", any(), "all, or a list of topics and patterns: [bow/ping, nav/*]", self.topics);
    visit("rename", "", any(), "recorded topic to port: {agent/command: command}", self.rename);
    visit("finish", "", any(), "end the run one second after the last message", self.finish);
  }
};

struct ReplayConfig : ReplayParameters {
  std::string file_place;  // where the user named it, for messages
  std::string topics_place;

  static ReplayConfig read(ConfigReader& from);
};

}  // namespace ensonify
