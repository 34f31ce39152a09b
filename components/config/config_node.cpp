#include "components/config/config_node.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

namespace ensonify {

namespace {

template <class T>
std::optional<T> parse_whole(const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  const bool hexadecimal = text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
  if (hexadecimal) {
    begin += 2;
  } else if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
    ++begin;
  }
  T value{};
  const auto parsed = std::from_chars(begin, end, value, hexadecimal ? 16 : 10);
  if (begin == end || parsed.ec != std::errc() || parsed.ptr != end || (hexadecimal && *begin == '-')) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

const ConfigNode* ConfigNode::find(const std::string& key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &found->value;
}

ConfigNode* ConfigNode::find(const std::string& key) {
  return const_cast<ConfigNode*>(static_cast<const ConfigNode*>(this)->find(key));
}

void ConfigNode::set(const std::string& key, ConfigNode value) {
  if (kind == Kind::kNull) {
    kind = Kind::kMap;
  }
  if (ConfigNode* old = find(key)) {
    *old = std::move(value);
    return;
  }
  const ConfigPlace value_place = value.place;
  entries.push_back({key, value_place, std::move(value)});
}

ConfigNode ConfigNode::text(std::string value, ConfigPlace place) {
  ConfigNode node;
  node.kind = Kind::kScalar;
  node.scalar = std::move(value);
  node.place = std::move(place);
  return node;
}

ConfigNode ConfigNode::map(ConfigPlace place) {
  ConfigNode node;
  node.kind = Kind::kMap;
  node.place = std::move(place);
  return node;
}

namespace {

std::string set_in_list(ConfigNode& list, const std::string& first, const std::string& rest, ConfigNode value) {
  std::size_t index = 0;
  const auto end = first.data() + first.size();
  const auto parsed = std::from_chars(first.data(), end, index);
  if (parsed.ec != std::errc() || parsed.ptr != end) {
    return "\"" + first + "\" does not count the values of a list";
  }
  if (index >= list.items.size()) {
    return "the list has " + std::to_string(list.items.size()) + " values; counted from 0";
  }
  if (rest.empty()) {
    list.items[index] = std::move(value);
    return "";
  }
  return set_config_value(list.items[index], rest, std::move(value));
}

}  // namespace

std::string set_config_value(ConfigNode& root, const std::string& path, ConfigNode value) {
  const std::size_t dot = path.find('.');
  const std::string first = path.substr(0, dot);
  const std::string rest = dot == std::string::npos ? "" : path.substr(dot + 1);
  if (path.empty() || path.front() == '.' || path.back() == '.' || path.find("..") != std::string::npos) {
    return "\"" + path + "\" is not a path of keys with dots between them";
  }
  if (root.is_list()) {
    return set_in_list(root, first, rest, std::move(value));
  }
  if (root.is_scalar()) {
    return "\"" + root.scalar + "\" holds no keys";
  }
  if (rest.empty()) {
    root.set(first, std::move(value));
    return "";
  }
  if (root.find(first) == nullptr) {
    root.set(first, ConfigNode::map(value.place));
  }
  return set_config_value(*root.find(first), rest, std::move(value));
}

namespace {

std::string json_text(const std::string& text) {
  static const char* const kHex = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte == 0x7f) {
      out += std::string("\\u00") + kHex[byte >> 4] + kHex[byte & 15];
    } else {
      out += c;
    }
  }
  return out + '"';
}

using Json = nlohmann::ordered_json;

Json scalar_json(const ConfigNode& node) {
  if (node.quoted) return node.scalar;
  if (node.scalar == "true" || node.scalar == "false") return node.scalar == "true";
  if (const auto whole = parse_integer(node.scalar)) return *whole;
  const auto number = parse_number(node.scalar);
  if (!number || !std::isfinite(*number)) return node.scalar;
  if (*number == std::trunc(*number) && std::abs(*number) < 1e15) return static_cast<std::int64_t>(*number);
  return *number;
}

Json json_of(const ConfigNode& node) {
  Json json;
  if (node.is_scalar()) json = scalar_json(node);
  if (node.is_list()) json = Json::array();
  if (node.is_map()) json = Json::object();
  for (const auto& item : node.items) json.push_back(json_of(item));
  for (const auto& entry : node.entries) json[entry.key] = json_of(entry.value);
  return json;
}

bool reads_as_plain(const std::string& text) {
  static const std::string kSafe = "_-./:+()$";
  const bool safe = std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return (c < 0x80 && std::isalnum(c) != 0) || kSafe.find(static_cast<char>(c)) != std::string::npos;
  });
  const bool starts_well = !text.empty() && std::isalnum(static_cast<unsigned char>(text[0])) != 0;
  return safe && starts_well && text.find(": ") == std::string::npos && text.back() != ':' &&
         bare_word(text) != BareWord::kNull;
}

std::string canonical_scalar(const ConfigNode& node) {
  if (!node.quoted && (parse_integer(node.scalar) || parse_number(node.scalar))) {
    return node.scalar;
  }
  std::string text = node.scalar;
  if (text.size() > 1 && text[0] == '/') {
    text = text.substr(text.find_last_not_of('/') == std::string::npos ? 0 : text.rfind('/', text.size() - 2) + 1);
  }
  const bool reads_as_value = bare_word(text) == BareWord::kBool || parse_integer(text) || parse_number(text);
  return reads_as_plain(text) && !(node.quoted && reads_as_value) ? text : json_text(text);
}

void write_canonical(const ConfigNode& node, std::size_t indent, std::string& out) {
  const std::string margin(indent, ' ');
  const auto nested = [&](const ConfigNode& value) {
    if ((value.is_map() && !value.entries.empty()) || (value.is_list() && !value.items.empty())) {
      out += "\n";
      write_canonical(value, indent + 2, out);
    } else if (value.is_scalar()) {
      out += " " + canonical_scalar(value) + "\n";
    } else {
      out += value.is_map() ? " {}\n" : value.is_list() ? " []\n" : " null\n";
    }
  };
  for (const auto& entry : node.entries) {
    out += margin + (reads_as_plain(entry.key) ? entry.key : json_text(entry.key)) + ":";
    nested(entry.value);
  }
  for (const auto& item : node.items) {
    out += margin + "-";
    nested(item);
  }
}

}  // namespace

std::string to_json(const ConfigNode& node) {
  return json_of(node).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_canonical_yaml(const ConfigNode& node) {
  std::string out;
  if (node.is_scalar()) {
    return canonical_scalar(node) + "\n";
  }
  write_canonical(node, 0, out);
  return out;
}

std::vector<ConfigProblem> apply(const Overrides& overrides, ConfigNode& root) {
  std::vector<ConfigProblem> problems;
  for (const auto& [path, value] : overrides) {
    if (const std::string why = set_config_value(root, path, value); !why.empty()) {
      problems.push_back({value.place, path, why});
    }
  }
  return problems;
}

std::optional<double> parse_number(const std::string& text) {
  std::string plain = text;
  double sign = 1.0;
  if (plain.size() > 1 && (plain[0] == '+' || plain[0] == '-')) {
    sign = plain[0] == '-' ? -1.0 : 1.0;
    plain.erase(0, 1);
  }
  if (plain == ".inf" || plain == ".Inf" || plain == ".INF" || plain == "inf" || plain == "infinity") {
    return sign * std::numeric_limits<double>::infinity();
  }
  if (plain == ".nan" || plain == ".NaN" || plain == ".NAN" || plain == "nan" || plain == "NaN") {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (plain.empty() || plain[0] == '-' || plain.find_first_not_of("0123456789.eE+-") != std::string::npos) {
    return std::nullopt;
  }
  double value = 0.0;
  const char* end = plain.data() + plain.size();
  const auto parsed = std::from_chars(plain.data(), end, value);
  if (parsed.ptr != end || parsed.ec == std::errc::invalid_argument) {
    return std::nullopt;
  }
  if (parsed.ec == std::errc::result_out_of_range) {
    value = std::strtod(plain.c_str(), nullptr);  // 1e999 is infinite, 1e-999 is zero
  }
  return sign * value;
}

std::optional<std::int64_t> parse_integer(const std::string& text) { return parse_whole<std::int64_t>(text); }

std::optional<std::uint64_t> parse_natural(const std::string& text) { return parse_whole<std::uint64_t>(text); }

BareWord bare_word(const std::string& text) {
  std::string word = text;
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word.empty() || word == "~" || word == "null") return BareWord::kNull;
  for (const char* of : {"true", "false", "yes", "no", "on", "off"}) {
    if (word == of) return BareWord::kBool;
  }
  return BareWord::kText;
}

std::string shortest_number(double value) {
  char text[64];
  for (int digits = 6; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) {
      break;
    }
  }
  return text;
}

}  // namespace ensonify
