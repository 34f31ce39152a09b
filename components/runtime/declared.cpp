#include "components/runtime/declared.h"

namespace ensonify {

std::string declarations_json(const std::vector<Declaration>& processes) {
  msg::Value::Map all;
  for (const Declaration& process : processes) {
    if (process.declares.empty()) continue;
    msg::Value::Map declarations;
    for (const auto& [type, content] : process.declares) declarations.emplace_back(type, content);
    all.emplace_back(process.process, msg::Value{std::move(declarations)});
  }
  return msg::to_json(msg::Value{std::move(all)});
}

}  // namespace ensonify
