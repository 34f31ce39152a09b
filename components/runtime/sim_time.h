#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace ensonify {

/// Time since the scenario's start, in whole nanoseconds. No float ever accumulates time.
using SimTime = std::chrono::nanoseconds;

inline constexpr SimTime kNever = SimTime::max();

/// For d >= 0.
constexpr SimTime saturating_add(SimTime t, SimTime d) { return t >= kNever - d ? kNever : t + d; }

constexpr double seconds(SimTime t) { return std::chrono::duration<double>(t).count(); }
/// Nearest nanosecond.
constexpr SimTime from_seconds(double t_s) {
  return SimTime{static_cast<std::int64_t>(t_s * 1e9 + (t_s < 0 ? -0.5 : 0.5))};
}

/// A rate as a fraction, num / den events per second, so that 15 Hz and 29.97 Hz are exact.
struct Rate {
  std::int64_t num = 0;  // 0: not periodic
  std::int64_t den = 1;

  constexpr double hz() const { return static_cast<double>(num) / static_cast<double>(den); }
  bool operator==(const Rate&) const = default;
};

/// To the nearest thousandth of a hertz.
inline Rate rate_of(double hz) { return {std::llround(hz * 1000.0), 1000}; }

/// Time of event n of a periodic port: phase + floor(n 10^9 den / num) ns, computed from n, never summed.
constexpr SimTime event_time(std::int64_t n, Rate rate, SimTime phase = SimTime{0}) {
  __extension__ using Wide = __int128;  // n may be large: 64 bits would overflow after hours
  const auto wide = static_cast<Wide>(n) * 1'000'000'000 * rate.den / rate.num;
  return phase + SimTime{static_cast<std::int64_t>(wide)};
}

/// Counts through the events of a periodic activity.
class Periodic {
 public:
  explicit Periodic(Rate rate, SimTime phase = SimTime{0}) : rate_(rate), phase_(phase) {}

  SimTime next() const { return event_time(n_, rate_, phase_); }
  std::int64_t count() const { return n_; }
  /// True, and on to the next event, when the next event is due at `now`.
  bool due(SimTime now) {
    if (next() > now) return false;
    ++n_;
    return true;
  }

 private:
  Rate rate_;
  SimTime phase_;
  std::int64_t n_ = 0;
};

inline namespace literals {
constexpr SimTime operator""_s(unsigned long long t) { return std::chrono::seconds(t); }
constexpr SimTime operator""_s(long double t) { return from_seconds(static_cast<double>(t)); }
constexpr SimTime operator""_ms(unsigned long long t) { return std::chrono::milliseconds(t); }
}  // namespace literals

}  // namespace ensonify
