#pragma once

#include <map>
#include <string>
#include <vector>

#include "components/runtime/wiring.h"
#include "messages/fields.h"

namespace ensonify {

/// Fact of a run: what its processes declare (Ports::declare), as JSON {PROCESS: {TYPE: fields}}.
inline constexpr const char* kDeclarationsFact = "declarations";
std::string declarations_json(const std::vector<Declaration>& processes);

/// The declarations of one type, by process. `json` is that fact; "" has none.
template <msg::Message M>
std::map<std::string, M> declared(const std::string& json) {
  std::map<std::string, M> found;
  if (json.empty()) return found;
  const msg::Value all = msg::from_json(json);
  const auto* processes = all.as<msg::Value::Map>();
  if (processes == nullptr) return found;
  for (const auto& [process, declarations] : *processes) {
    if (const msg::Value* content = declarations.find(M::kType)) msg::from_value(*content, found[process], process);
  }
  return found;
}
template <msg::Message M>
std::map<std::string, M> declared(const std::map<std::string, std::string>& facts) {
  const auto fact = facts.find(kDeclarationsFact);
  return declared<M>(fact == facts.end() ? std::string() : fact->second);
}

}  // namespace ensonify
