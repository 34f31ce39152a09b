// The only file that knows yaml-cpp: turns its events into ConfigNodes that carry their places.
#include "components/config/parse_yaml.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <unordered_map>

#include "components/errors/printable.h"

namespace ensonify {
namespace {

constexpr std::size_t kMostLevels = 100;
constexpr std::size_t kMostValues = 200'000;
constexpr std::size_t kMostBytes = 16 << 20;

[[noreturn]] void fail(const ConfigPlace& place, const std::string& message) {
  throw ConfigError({{place, "", message}});
}

class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::string file) : file_(std::move(file)) {}

  ConfigNode root;
  std::vector<ConfigProblem> problems;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(value_at(mark), anchor); }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    if (!is_utf8(value)) fail(place(mark), kNotUtf8);
    ConfigNode node = value_at(mark);
    node.kind = ConfigNode::Kind::kScalar;
    node.scalar = value;
    node.quoted = tag != "?";
    add(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) {
      fail(place(mark), "the alias stands inside its own anchor");
    }
    values_ += count(found->second);
    check_size(mark);
    add(found->second, YAML::NullAnchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, anchor, ConfigNode::Kind::kList);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, anchor, ConfigNode::Kind::kMap);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    ConfigNode node;
    YAML::anchor_t anchor;
    bool have_key = false;
    std::string key = {};
    ConfigPlace key_place = {};
    std::unordered_map<std::string, int> lines = {};  // of the keys so far: a search of the entries would be quadratic
  };

  ConfigPlace place(const YAML::Mark& mark) const { return {file_, mark.line + 1, mark.column + 1}; }

  ConfigNode value_at(const YAML::Mark& mark) {
    ++values_;
    check_size(mark);
    ConfigNode node;
    node.place = place(mark);
    return node;
  }

  void check_size(const YAML::Mark& mark) const {
    if (values_ > kMostValues) {
      fail(place(mark), "the document grows beyond " + std::to_string(kMostValues) + " values");
    }
  }

  static std::size_t count(const ConfigNode& node) {
    std::size_t values = 1;
    for (const auto& item : node.items) {
      values += count(item);
    }
    for (const auto& entry : node.entries) {
      values += count(entry.value);
    }
    return values;
  }

  static std::size_t levels(const ConfigNode& node) {
    std::size_t most = 0;
    for (const auto& item : node.items) {
      most = std::max(most, levels(item));
    }
    for (const auto& entry : node.entries) {
      most = std::max(most, levels(entry.value));
    }
    return most + 1;
  }

  void open(const YAML::Mark& mark, YAML::anchor_t anchor, ConfigNode::Kind kind) {
    if (open_.size() >= kMostLevels) {
      fail(place(mark), "more than " + std::to_string(kMostLevels) + " levels of nesting");
    }
    if (expects_key()) {
      fail(place(mark), "a key must be a word; is a bracket left open?");
    }
    ConfigNode node = value_at(mark);
    node.kind = kind;
    open_.push_back({std::move(node), anchor});
  }

  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    add(std::move(done.node), done.anchor);
  }

  bool expects_key() const { return !open_.empty() && open_.back().node.is_map() && !open_.back().have_key; }

  std::string path_of(const std::string& key) const {
    std::string path;
    for (const auto& level : open_) {
      if (level.node.is_list()) {
        path += "[" + std::to_string(level.node.items.size()) + "]";
      } else if (&level != &open_.back()) {
        path += (path.empty() ? "" : ".") + level.key;
      }
    }
    return path + (path.empty() ? "" : ".") + key;
  }

  void add(ConfigNode node, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      anchors_[anchor] = node;
    }
    if (open_.empty()) {
      root = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.is_list()) {
      check_levels(node);
      parent.node.items.push_back(std::move(node));
    } else if (!parent.have_key) {
      if (!node.is_scalar()) {
        fail(node.place, "a key must be a word; is a bracket left open?");
      }
      parent.key = node.scalar;
      parent.key_place = node.place;
      parent.have_key = true;
    } else {
      parent.have_key = false;
      if (const auto [first, is_new] = parent.lines.emplace(parent.key, node.place.line); !is_new) {
        problems.push_back(
            {parent.key_place, path_of(parent.key), "is given twice, first on line " + std::to_string(first->second)});
        return;
      }
      check_levels(node);
      parent.node.entries.push_back({parent.key, parent.key_place, std::move(node)});
    }
  }

  // Aliases can nest deeper than the text itself does.
  void check_levels(const ConfigNode& node) const {
    if (!node.is_scalar() && open_.size() + levels(node) > 2 * kMostLevels) {
      fail(node.place, "more than " + std::to_string(2 * kMostLevels) + " levels of nesting");
    }
  }

  std::string file_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, ConfigNode> anchors_;
  std::size_t values_ = 0;
};

TreeBuilder build(const std::string& text, const std::string& file) {
  TreeBuilder builder(file);
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) {
      fail({file, 1, 1}, "is empty; a map of keys is expected");
    }
    TreeBuilder second(file);
    if (parser.HandleNextDocument(second)) {
      fail(second.root.place, "a second document begins; one is allowed");
    }
  } catch (const YAML::Exception& error) {
    const bool placed = !error.mark.is_null();
    fail({file, placed ? error.mark.line + 1 : 1, placed ? error.mark.column + 1 : 1}, "is not YAML: " + error.msg);
  }
  return builder;
}

void give_place(ConfigNode& node, const ConfigPlace& place) {
  node.place = place;
  node.from_command = place.line == 0;
  for (auto& item : node.items) {
    give_place(item, place);
  }
  for (auto& entry : node.entries) {
    entry.place = place;
    give_place(entry.value, place);
  }
}

}  // namespace

ConfigDocument parse_config(const std::string& text, const std::string& file) {
  TreeBuilder builder = build(text, file);
  if (builder.root.is_null()) {
    fail({file, 1, 1}, "is empty; a map of keys is expected");
  }
  if (!builder.root.is_map()) {
    fail(builder.root.place, "is not a map of keys");
  }
  return {std::move(builder.root), std::move(builder.problems)};
}

ConfigDocument parse_config_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    fail({path}, "no such file");
  }
  if (std::filesystem::is_directory(path, error)) {
    fail({path}, "is a folder; a YAML file is expected");
  }
  if (std::filesystem::symlink_status(path, error).type() == std::filesystem::file_type::fifo) {
    fail({path}, "is a named pipe; a YAML file is expected");  // which would wait for its writer for ever
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    fail({path}, "cannot be read");
  }
  std::string text;  // grows with what is read: a pipe does not state its size
  std::array<char, 1 << 16> part;
  while (stream) {
    stream.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kMostBytes) {
      fail({path}, "is larger than 16 MiB");
    }
  }
  return parse_config(text, path);
}

ConfigNode parse_config_value(const std::string& text, const ConfigPlace& place) {
  ConfigNode node;
  if (text.find_first_not_of(" \t\n") != std::string::npos) {
    try {
      TreeBuilder builder = build(text, place.file);
      if (!builder.problems.empty()) {
        fail(place, builder.problems.front().message);
      }
      node = std::move(builder.root);
    } catch (const ConfigError& error) {
      fail(place, error.problems().front().message);
    }
  }
  give_place(node, place);
  return node;
}

}  // namespace ensonify
