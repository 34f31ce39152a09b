#pragma once

#include <map>
#include <string>
#include <vector>

namespace ensonify {

class ConfigReader;

struct ReplayConfig {
  std::string file;                           // a record
  std::vector<std::string> topics = {"*"};    // names and patterns
  std::map<std::string, std::string> rename;  // recorded topic -> port
  bool finish = false;                        // end the run after the last message

  std::string file_place;  // where the user named it, for messages
  std::string topics_place;

  static ReplayConfig read(ConfigReader& from);
  bool operator==(const ReplayConfig& other) const {
    return file == other.file && topics == other.topics && rename == other.rename && finish == other.finish;
  }
};

}  // namespace ensonify
