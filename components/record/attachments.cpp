#include "components/record/format.h"

namespace ensonify::record {

std::vector<Attachment> attachments_of(const std::map<std::string, std::string>& facts) {
  std::vector<Attachment> files;
  for (const char* name : {"launch", "scenario"}) {
    const auto fact = facts.find(name);
    if (fact != facts.end()) files.push_back({std::string(name) + ".yaml", "application/yaml", fact->second});
  }
  for (const char* name : {"version", "seed"}) {
    const auto fact = facts.find(name);
    if (fact != facts.end()) files.push_back({name, "text/plain", fact->second});
  }
  std::string notes;
  for (const auto& [name, value] : facts) {
    if (name.find('/') != std::string::npos) notes += name + ": " + value + "\n";
  }
  if (!notes.empty()) files.push_back({"notes.yaml", "application/yaml", notes});
  return files;
}

}  // namespace ensonify::record
