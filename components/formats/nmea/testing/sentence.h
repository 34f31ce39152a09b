#pragma once

#include <cstdio>
#include <string>

namespace ensonify::nmea {

/// The body with its $, sum and line end.
inline std::string sentence(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char tail[8];
  std::snprintf(tail, sizeof tail, "*%02X\r\n", sum);
  return "$" + body + tail;
}

}  // namespace ensonify::nmea
