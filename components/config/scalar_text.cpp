#include "components/config/scalar_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <limits>

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
