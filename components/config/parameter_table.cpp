#include "components/config/parameter_info.h"
#include "components/config/scalars.h"

namespace ensonify {
namespace {

/// A cell may not hold a bar.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

std::string default_text(const ParameterInfo& p) {
  if (p.allowed.required) return "required";
  if (p.left_out) return "";
  return "`" +
         (p.value.is_scalar() ? p.value.quoted && p.value.scalar.empty() ? "\"\"" : p.value.scalar : to_json(p.value)) +
         "`";
}

void add_rows(const ParameterList& list, const std::string& path, std::string& table) {
  using Kind = ParameterInfo::Kind;
  for (const ParameterInfo& p : list) {
    const std::string key = path + p.key;
    if (p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed) {
      const std::string inner = key + (p.kind == Kind::kList ? "[]." : p.kind == Kind::kNamed ? ".NAME." : ".");
      table += "| `" + key + "` | | " +
               (p.kind == Kind::kSection ? ""
                : p.entries.empty()      ? "none"
                                         : "as below") +
               " | | " + cell(p.about) + " |\n";
      add_rows(p.members, inner, table);
    } else {
      table += "| `" + key + "` | " + p.unit + " | " + cell(default_text(p)) + " | " + cell(allowed_text(p)) + " | " +
               cell(p.about) + " |\n";
    }
  }
}

}  // namespace

std::string parameter_table(const ParameterList& list) {
  std::string table = "| parameter | unit | default | allowed | meaning |\n|---|---|---|---|---|\n";
  add_rows(list, "", table);
  return table;
}

}  // namespace ensonify
