/// How a ConfigReader reads one value: numbers, lists of them, words, paths.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "components/config/config_node.h"
#include "components/config/data_paths.h"
#include "components/config/read_parameters.h"
#include "components/config/reader_state.h"
#include "components/config/scalar_text.h"

namespace ensonify {

namespace {

constexpr std::size_t kLongestQuotedText = 60;

std::string quoted(const std::string& text) {
  return "\"" + (text.size() > kLongestQuotedText ? text.substr(0, kLongestQuotedText) + "..." : text) + "\"";
}

std::string range_text(double lo, double hi) {
  const bool below = lo > -std::numeric_limits<double>::max();
  const bool above = hi < std::numeric_limits<double>::max();
  if (!below && !above) {
    return "";
  }
  return (below ? "[" + shortest_number(lo) : "(-inf") + ", " + (above ? shortest_number(hi) + "]" : "inf)");
}

std::string number_text(double lo, double hi) {
  const std::string range = range_text(lo, hi);
  return range.empty() ? "a number" : "a number in " + range;
}

std::string integer_text(std::int64_t lo, std::int64_t hi) {
  std::string text = "a whole number";
  if (lo > std::numeric_limits<std::int64_t>::min() || hi < std::numeric_limits<std::int64_t>::max()) {
    text += " in [" + std::to_string(lo) + ", " + std::to_string(hi) + "]";
  }
  return text;
}

}  // namespace

std::string described(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::kNull: return "has no value";
    case ConfigNode::Kind::kList: return "is a list";
    case ConfigNode::Kind::kMap: return "is a map of keys";
    case ConfigNode::Kind::kScalar: break;
  }
  return "is " + quoted(node.scalar);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

bool ConfigReader::scalar(const ConfigNode& node, const std::string& path, double& value,
                          const NumberRange& range) const {
  const auto complain = [&](const std::string& message) {
    state_->documents->problems.push_back({node.place, path, message});
    return false;
  };
  const auto found = node.is_scalar() && !node.quoted ? parse_number(node.scalar) : std::nullopt;
  if (!found) {
    return complain(described(node) + ", not " + number_text(range.lo, range.hi));
  }
  if (!std::isfinite(*found)) {
    return complain(node.scalar + " is not finite; allowed: " + number_text(range.lo, range.hi));
  }
  if (*found < range.lo || *found > range.hi) {
    return complain(node.scalar + " is outside " + range_text(range.lo, range.hi));
  }
  value = *found * range.si_per_unit;
  return true;
}

std::optional<double> ConfigReader::number(std::string_view key, bool must, const NumberRange& range) const {
  double value = 0.0;
  const ConfigNode* node = take(key, must, number_text(range.lo, range.hi));
  return node != nullptr && scalar(*node, state_->path_of(key), value, range) ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> ConfigReader::integer(std::string_view key, bool must, const IntegerRange& range) const {
  const ConfigNode* node = take(key, must, integer_text(range.lo, range.hi));
  if (node == nullptr) {
    return std::nullopt;
  }
  const auto value = node->is_scalar() && !node->quoted ? parse_integer(node->scalar) : std::nullopt;
  if (!value) {
    problem(key, described(*node) + ", not " + integer_text(range.lo, range.hi));
    return std::nullopt;
  }
  if (*value < range.lo || *value > range.hi) {
    problem(key, node->scalar + " is outside [" + std::to_string(range.lo) + ", " + std::to_string(range.hi) + "]");
    return std::nullopt;
  }
  return value;
}

std::optional<std::uint64_t> ConfigReader::natural(std::string_view key, bool must) const {
  const std::string allowed = "a whole number from 0 to 2^64 - 1";
  const ConfigNode* node = take(key, must, allowed);
  if (node == nullptr) {
    return std::nullopt;
  }
  const auto value = node->is_scalar() && !node->quoted ? parse_natural(node->scalar) : std::nullopt;
  if (!value) {
    problem(key, described(*node) + ", not " + allowed);
  }
  return value;
}

bool ConfigReader::numbers(std::string_view key, std::span<double> values, bool must, const NumberRange& range) const {
  const std::string allowed = "a list of " + std::to_string(values.size()) + " numbers" +
                              (range_text(range.lo, range.hi).empty() ? "" : " in " + range_text(range.lo, range.hi));
  const ConfigNode* node = take(key, must, allowed);
  if (node == nullptr) {
    return false;
  }
  if (!node->is_list() || node->items.size() != values.size()) {
    const std::string what =
        node->is_list() ? "has " + std::to_string(node->items.size()) + " values" : described(*node);
    problem(key, what + ", not " + allowed);
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    good &= scalar(node->items[i], state_->path_of(key) + "[" + std::to_string(i) + "]", values[i], range);
  }
  return good;
}

std::optional<std::vector<double>> ConfigReader::any_numbers(std::string_view key, bool must,
                                                             const NumberRange& range) const {
  const ConfigNode* node = take(key, must, "a list of numbers");
  if (node == nullptr) {
    return std::nullopt;
  }
  if (!node->is_list()) {
    problem(key, described(*node) + ", not a list of numbers");
    return std::nullopt;
  }
  std::vector<double> values(node->items.size());
  bool good = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    good &= scalar(node->items[i], state_->path_of(key) + "[" + std::to_string(i) + "]", values[i], range);
  }
  return good ? std::optional(std::move(values)) : std::nullopt;
}

std::optional<std::vector<double>> ConfigReader::rows(std::string_view key, std::size_t width, bool must,
                                                      const NumberRange& range) const {
  const std::string allowed = "a list of lists of " + std::to_string(width) + " numbers";
  const ConfigNode* node = take(key, must, allowed);
  if (node == nullptr) {
    return std::nullopt;
  }
  if (!node->is_list()) {
    problem(key, described(*node) + ", not " + allowed);
    return std::nullopt;
  }
  std::vector<double> values;
  bool good = true;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    const ConfigNode& row = node->items[i];
    const std::string path = state_->path_of(key) + "[" + std::to_string(i) + "]";
    if (!row.is_list() || row.items.size() != width) {
      state_->documents->problems.push_back(
          {row.place, path, "is not a list of " + std::to_string(width) + " numbers, as a place in this list must be"});
      good = false;
      continue;
    }
    for (std::size_t k = 0; k < width; ++k) {
      values.push_back(0.0);
      good &= scalar(row.items[k], path + "[" + std::to_string(k) + "]", values.back(), range);
    }
  }
  return good ? std::optional(std::move(values)) : std::nullopt;
}

void ConfigReader::read(std::string_view key, bool& value, bool must) const {
  const ConfigNode* node = take(key, must, "true, false");
  if (node == nullptr) {
    return;
  }
  if (node->is_scalar() && !node->quoted && (node->scalar == "true" || node->scalar == "false")) {
    value = node->scalar == "true";
  } else {
    problem(key, described(*node) + ", not true or false");
  }
}

void ConfigReader::read(std::string_view key, std::string& value, bool must) const {
  const ConfigNode* node = take(key, must, "text");
  if (node == nullptr) {
    return;
  }
  if (node->is_scalar()) {
    value = node->scalar;
  } else {
    problem(key, described(*node) + ", not text");
  }
}

void ConfigReader::read(std::string_view key, std::vector<std::string>& value, bool must) const {
  const ConfigNode* node = take(key, must, "a list of texts");
  if (node == nullptr) {
    return;
  }
  if (!node->is_list()) {
    problem(key, described(*node) + ", not a list of texts");
    return;
  }
  std::vector<std::string> found;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    const ConfigNode& item = node->items[i];
    if (item.is_scalar()) {
      found.push_back(item.scalar);
    } else {
      state_->documents->problems.push_back(
          {item.place, state_->path_of(key) + "[" + std::to_string(i) + "]", described(item) + ", not text"});
    }
  }
  if (found.size() == node->items.size()) {
    value = std::move(found);
  }
}

std::optional<std::size_t> ConfigReader::word(std::string_view key, const std::vector<std::string>& words,
                                              bool must) const {
  const ConfigNode* node = take(key, must, joined(words));
  if (node == nullptr) {
    return std::nullopt;
  }
  const auto found = std::find(words.begin(), words.end(), node->is_scalar() ? node->scalar : "");
  if (!node->is_scalar() || found == words.end()) {
    problem(key, described(*node) + ", not one of " + joined(words));
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - words.begin());
}

void ConfigReader::read_path(std::string_view key, std::string& path, bool must) const {
  namespace fs = std::filesystem;
  const ConfigNode* node = take(key, must, "a path");
  if (node == nullptr) {
    return;
  }
  if (!node->is_scalar() || node->scalar.empty()) {
    problem(key, described(*node) + ", not a path");
    return;
  }
  std::vector<std::string> folders;
  if (node->from_command) {
    folders.emplace_back(".");
  }
  folders.push_back(fs::path(node->place.file).parent_path().string());
  const std::string found = find_data(node->scalar, folders);
  if (found.empty()) {
    problem(key,
            quoted(node->scalar) + ": no such file or folder" +
                (fs::path(node->scalar).is_absolute() ? "" : " (searched beside this file and in the data folders)"));
    return;
  }
  path = found;
}

void refuse_empty(const ConfigReader& from, const char* key, const std::string& text) {
  if (text.empty() && from.has(key)) from.problem(key, "is empty; allowed: a text");
}

namespace detail {

std::optional<std::size_t> form_given(const ConfigReader& from, const Forms& forms,
                                      const std::vector<std::vector<std::string>>& keys) {
  std::optional<std::size_t> given;
  std::string known;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].empty()) continue;
    if (forms.none.empty() && i + 1 == keys.size()) break;  // without a key of its own
    const std::string& key = keys[i].front();
    known += (known.empty() ? "" : ", ") + key;
    if (!from.has(key)) continue;
    if (given && !forms.beside.empty())
      from.problem(key, "stands beside " + keys[*given].front() + "; " + forms.beside);
    if (!given) given = i;
  }
  if (given) return given;
  if (forms.none.empty()) return keys.size() - 1;
  std::string none = forms.none;
  if (const std::size_t at = none.find("{}"); at != std::string::npos) none.replace(at, 2, known);
  from.problem("", none);
  return std::nullopt;
}

void refuse_others(const ConfigReader& from, const Forms& forms, const std::vector<std::vector<std::string>>& keys,
                   std::size_t given) {
  const auto has = [&](const std::string& key) {
    return std::find(keys[given].begin(), keys[given].end(), key) != keys[given].end();
  };
  for (const auto& form : keys) {
    for (const std::string& key : form) {
      if (!has(key) && from.has(key)) from.problem(key, forms.beside);
    }
  }
}

bool whole(const ConfigReader& from, const char* key, const Allowed& allowed, const std::vector<double>& numbers) {
  const bool all = std::all_of(numbers.begin(), numbers.end(), [](double x) { return x == std::floor(x); });
  if (!all) {
    const std::string what = allowed.called.empty() ? "" : allowed.called + ", ";
    from.problem(key, "holds a number that is not " + what + "a whole number");
  }
  return all;
}

bool is_map_or(const ConfigReader& from, const char* key, const std::string& word,
               const std::vector<std::string>& keys) {
  const ConfigNode* node = from.node(key);
  if (node == nullptr || node->is_map()) return true;
  from.problem(key, "is neither " + word + " nor a map of " + joined(keys));
  return false;
}

std::optional<std::uint64_t> number_of(const ConfigReader& from, const std::string& key, const Allowed& allowed,
                                       const std::string& name) {
  const auto number = parse_natural(name);
  if (number && static_cast<double>(*number) >= allowed.lo && static_cast<double>(*number) <= allowed.hi) return number;
  const std::string what = allowed.called.empty() ? "" : allowed.called + ", ";
  from.problem(key + "." + name, "is not " + what + "a whole number in " + range_text(allowed.lo, allowed.hi));
  return std::nullopt;
}

}  // namespace detail
}  // namespace ensonify
