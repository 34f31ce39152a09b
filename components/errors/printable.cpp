#include "components/errors/printable.h"

namespace ensonify {
namespace {

/// Bytes of the character that a text begins with; 0: none of UTF-8 [RFC3629].
std::size_t character_bytes(std::string_view text) {
  const auto byte = [&](std::size_t at) { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U; };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  if (length == 0) return 0;
  unsigned code = length == 1 ? first : first & (0x7FU >> length);
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xC0U) != 0x80) return 0;
    code = code << 6U | (byte(k) & 0x3FU);
  }
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  const bool too_long = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  return surrogate || too_long || code > 0x10FFFF ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string out;
  out.reserve(text.size());
  const auto escape = [&](char byte) {
    out += "\\x";
    out += kHex[static_cast<unsigned char>(byte) >> 4U];
    out += kHex[static_cast<unsigned char>(byte) & 15U];
  };
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t bytes = character_bytes(text.substr(i));
    const auto first = static_cast<unsigned char>(text[i]);
    const bool second_set =
        bytes == 2 && first == 0xC2 && static_cast<unsigned char>(text[i + 1]) < 0xA0;  // U+0080 to U+009F
    const bool control = (first < 0x20 && first != '\n' && first != '\t') || first == 0x7F;
    if (second_set) escape(text[i + 1]);
    else if (bytes == 0 || control) escape(text[i]);
    else out += text.substr(i, bytes);
    i += bytes == 0 ? 1 : bytes;
  }
  return out;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t bytes = character_bytes(text.substr(i));
    if (bytes == 0) return false;
    i += bytes;
  }
  return true;
}

}  // namespace ensonify
