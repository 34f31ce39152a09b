#pragma once

#include <string>

#include "tools/feed/examine.h"
#include "tools/feed/signs.h"

/// Findings in words, and the source of nav_feed that they make.
namespace ensonify::feed_doctor {

struct Report {
  std::string text;
  int faults = 0;  // what is to be corrected
};

/// `way` is how the bytes come, as nav_feed's sources have it: "udp: 10110".
Report report_of(const Findings& found, const std::string& way);

}  // namespace ensonify::feed_doctor
