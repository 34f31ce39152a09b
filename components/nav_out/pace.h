#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace ensonify::nav_out {

/// Which of an instrument's measurements leave as a sentence: those nearest to the instants of the sentence's rate,
/// which are counted from a whole second of UTC. A clock that jitters by less than half an interval of the
/// instrument's skips none and doubles none.
class Pace {
 public:
  /// `start_unix_ns`: UTC of sim time 0.
  Pace(double hz, double instrument_hz, std::int64_t start_unix_ns)
      : hz_(hz), early_(0.5 * hz / instrument_hz), second_ns_(start_unix_ns % 1'000'000'000) {}

  bool take(std::int64_t stamp_ns) {
    const double t_s = 1e-9 * static_cast<double>(second_ns_ + stamp_ns);
    const auto instant = static_cast<std::int64_t>(std::floor(t_s * hz_ + early_));
    if (last_ && instant <= *last_) return false;
    last_ = instant;
    return true;
  }

 private:
  double hz_, early_;
  std::int64_t second_ns_;
  std::optional<std::int64_t> last_;
};

}  // namespace ensonify::nav_out
