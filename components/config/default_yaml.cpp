#include <algorithm>

#include "components/config/parameter_info.h"
#include "components/config/scalars.h"

namespace ensonify {
namespace {

constexpr std::size_t kFarthestComment = 36;  // column

struct Line {
  std::string text;
  std::string about;
};

bool reads_as_text(const std::string& text) {
  static const std::string kSafe = "_-./";
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || kSafe.find(static_cast<char>(c)) < 4; };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
         std::all_of(text.begin(), text.end(), plain) && text != "true" && text != "false" && text != "null";
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

class YamlWriter {
 public:
  /// `given`: the list has values, not defaults. `lead` is the margin of the first line.
  void write(const ParameterList& list, bool given, const std::string& lead, const std::string& margin) {
    for (const ParameterInfo& p : list) write(p, given, &p == list.data() ? lead : margin, margin);
  }

  std::string text() const {
    std::size_t column = 0;
    for (const Line& line : lines_) {
      if (line.text.size() <= kFarthestComment) column = std::max(column, line.text.size());
    }
    std::string text;
    for (const Line& line : lines_) {
      text += line.text;
      if (!line.about.empty()) {
        text += std::string(column > line.text.size() ? column - line.text.size() : 0, ' ') + "  # " + line.about;
      }
      text += '\n';
    }
    return text;
  }

 private:
  using Kind = ParameterInfo::Kind;

  void write(const ParameterInfo& p, bool given, const std::string& lead, const std::string& margin) {
    if (p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed) {
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

std::string default_yaml(const std::string& title, const ParameterList& list) {
  YamlWriter writer;
  writer.write(list, false, "", "");
  return "# " + title + "\n" + writer.text();
}

}  // namespace ensonify
