#include "components/config/config_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "components/config/scalar_text.h"

namespace ensonify {
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

}  // namespace ensonify
