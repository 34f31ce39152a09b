#include "components/record/format.h"
#include "components/runtime/declared.h"
#include "messages/value.h"

namespace ensonify::record {

std::vector<Attachment> attachments_of(const std::map<std::string, std::string>& facts) {
  std::vector<Attachment> files;
  for (const char* name : {"launch", "scenario"}) {
    const auto fact = facts.find(name);
    if (fact != facts.end()) files.push_back({std::string(name) + ".yaml", "application/yaml", fact->second});
  }
  for (const char* name : {"version", "seed", "isa"}) {
    const auto fact = facts.find(name);
    if (fact != facts.end()) files.push_back({name, "text/plain", fact->second});
  }
  if (const auto fact = facts.find(kDeclarationsFact); fact != facts.end() && fact->second != "{}")
    files.push_back({kDeclarationsName, "application/json", fact->second});
  msg::Value::Map own;  // of participants: PROCESS/KEY
  for (const auto& [name, text] : facts) {
    if (name.find('/') != std::string::npos) own.emplace_back(name, msg::Value{text});
  }
  if (!own.empty()) files.push_back({"facts.json", "application/json", msg::to_json(msg::Value{std::move(own)})});
  return files;
}

}  // namespace ensonify::record
