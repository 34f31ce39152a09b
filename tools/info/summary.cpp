#include "tools/info/summary.h"

#include <algorithm>
#include <cmath>

namespace ensonify::info {

void Range::add(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

void Extent::add(double latitude_deg, double longitude_deg) {
  const bool usable =
      std::abs(latitude_deg) <= 90 && std::abs(longitude_deg) <= 360 && (latitude_deg != 0 || longitude_deg != 0);
  if (!usable) {  // NaN too
    ++unusable_;
    return;
  }
  if (latitude_deg_.empty()) first_deg_ = longitude_deg;
  latitude_deg_.add(latitude_deg);
  unwrapped_deg_.add(first_deg_ + std::remainder(longitude_deg - first_deg_, 360.0));
}

double Extent::west_deg() const { return std::remainder(unwrapped_deg_.low, 360.0); }
double Extent::east_deg() const { return std::remainder(unwrapped_deg_.high, 360.0); }

void Stream::add(std::int64_t time_ns, int sensor) {
  if (const auto before = newest_ns_.find(sensor); before != newest_ns_.end() && time_ns < before->second) ++backward;
  newest_ns_[sensor] = time_ns;
  if (count++ == 0) {
    first_ns = last_ns = time_ns;
    return;
  }
  if (time_ns - last_ns > longest_gap_ns) {
    longest_gap_ns = time_ns - last_ns;
    gap_begin_ns = last_ns;
  }
  first_ns = std::min(first_ns, time_ns);
  last_ns = std::max(last_ns, time_ns);
}

double Stream::rate_hz() const {
  const auto sensors = static_cast<double>(newest_ns_.size());
  if (static_cast<double>(count) < 2.0 * sensors || last_ns == first_ns) return 0;
  return (static_cast<double>(count) / sensors - 1.0) / (1e-9 * static_cast<double>(last_ns - first_ns));
}

void Pings::add_modulo(std::uint16_t number, std::int64_t time_ns) {
  if (numbers_.empty()) {
    modulo_ = true;
    return add(kModulo + number, time_ns);  // room for those that stand out of order
  }
  // The nearest number of this remainder, before the last one or after it.
  const auto step = static_cast<std::int16_t>(static_cast<std::uint16_t>(number - last_));
  const bool before_zero = step < 0 && static_cast<std::uint64_t>(-step) > last_;
  add(before_zero ? number : last_ + static_cast<std::uint64_t>(std::int64_t{step}), time_ns);
}

void Pings::add(std::uint64_t number, std::int64_t time_ns) {
  times_.add(time_ns);
  numbers_.emplace(number, time_ns);
  last_ = number;
}

std::vector<Pings::Gap> Pings::gaps() const {
  std::vector<Gap> gaps;
  for (auto ping = numbers_.begin(); ping != numbers_.end(); ++ping) {
    const auto next = std::next(ping);
    if (next == numbers_.end()) break;
    const std::uint64_t first = ping->first + 1;
    if (next->first > first) gaps.push_back({modulo_ ? first % kModulo : first, next->first - first, ping->second});
  }
  return gaps;
}

}  // namespace ensonify::info
