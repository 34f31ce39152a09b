#pragma once

#include <optional>
#include <vector>

/// How evenly what comes again and again comes.
namespace ensonify::feed_doctor {

/// The value below which this share of them lies; there must be some.
double quantile(std::vector<double> values, double share);

struct Rhythm {
  std::optional<double> rate_hz;  // by the median interval; nothing where most come several at once
  double jitter_ms = 0.0;         // 95 of 100 intervals differ from the median one by this at most
};

/// Of times that go on after `wrap_s` (0: they do not). Nothing of fewer than three.
std::optional<Rhythm> rhythm_of(const std::vector<double>& times_s, double wrap_s);

}  // namespace ensonify::feed_doctor
