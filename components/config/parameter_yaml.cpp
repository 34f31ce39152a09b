/// Files of YAML that are written from lists: of defaults, and of values.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "components/config/config_text.h"
#include "components/config/parameter_info.h"
#include "components/config/scalar_text.h"

namespace ensonify {

namespace {

using Json = nlohmann::ordered_json;
using Kind = ParameterInfo::Kind;

constexpr std::size_t kFarthestComment = 36;  // column

struct Line {
  std::string text;
  std::string about;
};

bool reads_as_text(const std::string& text) {
  static const std::string kSafe = "_-./";
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || kSafe.find(static_cast<char>(c)) < 4; };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
         std::all_of(text.begin(), text.end(), plain) && bare_word(text) == BareWord::kText;
}

std::string flow_text(const ConfigNode& node) {
  if (node.is_list()) {
    std::string text;
    for (const ConfigNode& item : node.items) text += (text.empty() ? "" : ", ") + flow_text(item);
    return "[" + text + "]";
  }
  if (node.is_map()) return to_json(node);
  return node.quoted && !reads_as_text(node.scalar) ? to_json(node) : node.scalar;
}

std::string comment_of(const ParameterInfo& p) {
  std::string text = p.about;
  if (const std::string allowed = allowed_text(p); !allowed.empty()) text += (text.empty() ? "" : "; ") + allowed;
  if (p.allowed.required) text += "; must be given";
  return text;
}

std::string key_text(const std::string& key) {
  const bool digits = !key.empty() && key.find_first_not_of("0123456789") == std::string::npos;
  return digits || reads_as_text(key) ? key : Json(key).dump();
}

/// A single value as a block may have it.
std::string plain_text(const ConfigNode& node) {
  const bool is_value = !node.quoted && (parse_number(node.scalar) || parse_integer(node.scalar) ||
                                         node.scalar == "true" || node.scalar == "false");
  return is_value || reads_as_text(node.scalar) ? node.scalar : Json(node.scalar).dump();
}

bool holds_scalars(const ConfigNode& list) {
  return !list.items.empty() &&
         std::all_of(list.items.begin(), list.items.end(), [](const ConfigNode& item) { return item.is_scalar(); });
}

/// A list of single values in one line.
std::string line_of(const ConfigNode& list) {
  std::string text;
  for (const ConfigNode& item : list.items) text += (text.empty() ? "" : ", ") + plain_text(item);
  return "[" + text + "]";
}

void add_block(const ConfigNode& node, const std::string& lead, const std::string& margin, std::vector<Line>& lines) {
  bool first = true;
  const auto add = [&](const std::string& key, const ConfigNode& value, bool is_item) {
    const std::string start = (std::exchange(first, false) ? lead : margin) + key;
    const bool filled = !value.items.empty() || !value.entries.empty();
    if (holds_scalars(value)) lines.push_back({start + " " + line_of(value), ""});
    else if (filled && is_item) add_block(value, start + " ", margin + "  ", lines);
    else if (filled) {
      lines.push_back({start, ""});
      add_block(value, margin + "  ", margin + "  ", lines);
    } else {
      lines.push_back({start + (value.is_map()    ? " {}"
                                : value.is_list() ? " []"
                                : value.is_null() ? ""
                                                  : " " + plain_text(value)),
                       ""});
    }
  };
  for (const auto& entry : node.entries) add(key_text(entry.key) + ":", entry.value, false);
  for (const ConfigNode& item : node.items) add("-", item, true);
}

/// A file of values: nothing that has none.
class ValueWriter {
 public:
  void write(const ParameterList& list, const std::string& lead, const std::string& margin) {
    bool first = true;
    for (const ParameterInfo* p : written(list)) {
      write(*p, std::exchange(first, false) ? lead : margin, margin);
    }
  }

  std::vector<Line> lines;

 private:
  /// What of a list has a value, with the keys of the form that is there.
  static std::vector<const ParameterInfo*> written(const ParameterList& list) {
    std::vector<const ParameterInfo*> all;
    for (const ParameterInfo& p : list) {
      if (p.kind == Kind::kForms) {
        for (const ParameterInfo* inner : written(p.members)) all.push_back(inner);
      } else if (p.kind == Kind::kSection && p.left_out) {
        if (!p.allowed.instead.empty()) all.push_back(&p);
      } else if (p.kind == Kind::kSection) {
        if (p.optional || p.allowed.required || !written(p.members).empty()) all.push_back(&p);
      } else if (!p.left_out) {
        all.push_back(&p);
      }
    }
    return all;
  }

  void write(const ParameterInfo& p, const std::string& lead, const std::string& margin) {
    const std::string inner = margin + "  ";
    const std::string about = p.about + (p.unit.empty() ? "" : " (" + p.unit + ")");
    const bool structure = p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed;
    if (structure && p.left_out) return lines.push_back({lead + p.key + ": " + p.allowed.instead, about});
    if (p.kind == Kind::kOther && holds_scalars(p.value)) {
      return lines.push_back({lead + p.key + ": " + line_of(p.value), about});
    }
    if (p.kind == Kind::kOther && (!p.value.entries.empty() || !p.value.items.empty())) {
      lines.push_back({lead + p.key + ":", about});
      return add_block(p.value, inner, inner, lines);
    }
    if (!structure) return lines.push_back({lead + p.key + ": " + flow_text(p.value), about});
    if (p.kind == Kind::kSection) return write_map(p.members, lead + p.key + ":", about, inner);
    if (p.entries.empty()) {
      return lines.push_back({lead + p.key + (p.kind == Kind::kNamed ? ": {}" : ": []"), about});
    }
    lines.push_back({lead + p.key + ":", about});
    for (const auto& [name, entry] : p.entries) {
      if (p.kind == Kind::kNamed) {
        write_map(entry, inner + key_text(name) + ":", "", inner + "  ");
      } else if (written(entry).empty()) {
        lines.push_back({inner + "- {}", ""});
      } else {
        write(entry, inner + "- ", inner + "  ");
      }
    }
  }

  void write_map(const ParameterList& list, const std::string& key, const std::string& about,
                 const std::string& margin) {
    const bool empty = written(list).empty();
    lines.push_back({key + (empty ? " {}" : ""), about});
    write(list, margin, margin);
  }
};

std::string text_of(const std::vector<Line>& lines) {
  std::size_t column = 0;
  for (const Line& line : lines) {
    if (line.text.size() <= kFarthestComment) column = std::max(column, line.text.size());
  }
  std::string text;
  for (const Line& line : lines) {
    text += line.text;
    if (!line.about.empty()) {
      text += std::string(column > line.text.size() ? column - line.text.size() : 0, ' ') + "  # " + line.about;
    }
    text += '\n';
  }
  return text;
}

class YamlWriter {
 public:
  /// `given`: the list has values, not defaults. `lead` is the margin of the first line.
  void write(const ParameterList& list, bool given, const std::string& lead, const std::string& margin) {
    for (const ParameterInfo& p : list) write(p, given, &p == list.data() ? lead : margin, margin);
  }

  std::string text() const { return text_of(lines_); }

 private:
  using Kind = ParameterInfo::Kind;

  void write(const ParameterInfo& p, bool given, const std::string& lead, const std::string& margin) {
    if (p.kind == Kind::kForms) {
      write(p.members, given, lead, margin);
    } else if (p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed) {
      write_structure(p, lead, margin);
    } else if (p.left_out && !(given && p.allowed.required)) {
      lines_.push_back({commented(lead) + p.key + ":", comment_of(p)});
    } else {
      lines_.push_back({lead + p.key + ": " + flow_text(p.value), comment_of(p)});
    }
  }

  void write_structure(const ParameterInfo& p, const std::string& lead, const std::string& margin) {
    const std::string inner = margin + "  ";
    if (p.kind == Kind::kSection) {
      lines_.push_back({(p.left_out ? commented(lead) : lead) + p.key + ":", comment_of(p)});
      const std::string to = p.left_out ? commented(inner) : inner;
      write(p.members, false, to, to);
    } else if (!p.entries.empty()) {
      lines_.push_back({lead + p.key + ":", comment_of(p)});
      for (const auto& [name, entry] : p.entries) {
        if (p.kind == Kind::kNamed) {
          lines_.push_back({inner + name + ":", ""});
          write(entry, true, inner + "  ", inner + "  ");
        } else {
          write(entry, true, inner + "- ", inner + "  ");
        }
      }
    } else {
      lines_.push_back({lead + p.key + (p.kind == Kind::kNamed ? ": {}" : ": []"), comment_of(p)});
      const std::string to = commented(inner);
      if (p.kind == Kind::kNamed) lines_.push_back({to + "NAME:", ""});
      write(p.members, true, to + (p.kind == Kind::kNamed ? "  " : "- "), to + "  ");
    }
  }

  static std::string commented(const std::string& margin) { return margin.starts_with("#") ? margin : "# " + margin; }

  std::vector<Line> lines_;
};

}  // namespace

std::string block_yaml(const ConfigNode& node, const std::string& margin) {
  std::vector<Line> lines;
  add_block(node, margin, margin, lines);
  return text_of(lines);
}

std::string written_yaml(const ParameterList& values, const std::string& margin) {
  ValueWriter writer;
  writer.write(values, margin, margin);
  return text_of(writer.lines);
}

std::string default_yaml(const std::string& title, const ParameterList& list) {
  YamlWriter writer;
  writer.write(list, false, "", "");
  return "# " + title + "\n" + writer.text();
}

}  // namespace ensonify
