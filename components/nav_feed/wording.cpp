#include "components/nav_feed/wording.h"

#include <cmath>
#include <cstdio>

namespace ensonify {

std::string duration_text(double seconds) {
  const double size = std::abs(seconds);
  const auto whole = static_cast<long>(std::llround(size));
  char text[48];
  if (whole >= 3600) {
    const long minutes = std::lround(size / 60.0);
    std::snprintf(text, sizeof text, "%ld h %ld min", minutes / 60, minutes % 60);
  } else if (whole >= 60) {
    std::snprintf(text, sizeof text, "%ld min %ld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%.1f s", size);
  }
  return text;
}

std::string distance_text(double metres) {
  const double size = std::abs(metres);
  char text[32];
  std::snprintf(text, sizeof text, size < 1e3 ? "%.0f m" : "%.1f km", size < 1e3 ? size : size / 1e3);
  return text;
}

}  // namespace ensonify
