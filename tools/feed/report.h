#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/feed/examine.h"
#include "tools/feed/signs.h"

/// Findings in words, and the source of nav_feed that they make.
namespace ensonify::feed_doctor {

struct Report {
  std::string text;
  std::vector<std::string> faults;  // what is to be corrected, a sentence each; they are in the text too
  std::string time_scale;           // "utc" or "gps"; it and what follows are empty where no format is known
  std::string time_scale_why;
  std::vector<Sign> signs;
  std::optional<double> antenna_up_m;  // above the roll centre
  std::string source;                  // of nav_feed, YAML: "{ udp: 10110, motion: false }"
};

/// How the receiving itself went; of a file all is well.
struct Reception {
  std::size_t refused = 0;  // datagrams or connections of others
  std::string trouble;      // of the connection or line
};

/// `way` is how the bytes come, as nav_feed's sources have it: "udp: 10110".
Report report_of(const Findings& found, const std::string& way);

/// The same as one JSON object. What is not known is null.
std::string json_of(const Findings& found, const Report& report, const Reception& reception);

}  // namespace ensonify::feed_doctor
