#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ensonify::formats {

/// Water level above chart datum, by readings of a gauge.
class Tide {
 public:
  /// Lines "2025-06-01T12:00:00Z,1.35", or of CARIS's .tid files "2025/06/01 12:00:00 1.35", UTC and rising; # begins a
  /// remark, names or dashes may stand before them. Throws UserError with the line of a mistake.
  explicit Tide(std::string file);

  const std::string& file() const { return file_; }
  /// Straight between readings. Throws UserError before the first and after the last.
  double level_m(std::int64_t unix_ns) const;

 private:
  std::string file_;
  std::vector<std::pair<std::int64_t, double>> readings_;  // ns since 1970, m
};

}  // namespace ensonify::formats
