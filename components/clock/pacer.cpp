#include "components/clock/pacer.h"

#include <algorithm>

namespace ensonify::clock {

void Pacer::start(WallTime now) {
  if (started_) return;
  started_ = true;
  origin_wall_ = now;
}

SimTime Pacer::cap(WallTime now) const {
  if (paused_) return pause_cap_;
  if (!rate_) return kNever;
  if (!started_) return origin_sim_;
  const double elapsed_s = std::chrono::duration<double>(now - origin_wall_).count();
  const double ahead_s = std::max(0.0, elapsed_s) * *rate_;
  const bool for_ever = ahead_s >= seconds(kNever - std::max(origin_sim_, SimTime{0})) - 1.0;  // no overflow
  return for_ever ? kNever : origin_sim_ + from_seconds(ahead_s);
}

std::optional<WallTime> Pacer::when(SimTime t) const {
  if (paused_ || !rate_ || !started_ || t == kNever) return std::nullopt;
  constexpr double kLongest_s = 1e9;  // decades; more would not fit
  const std::chrono::duration<double> ahead(std::min(seconds(t - origin_sim_) / *rate_, kLongest_s));
  // A nanosecond more, so that rounding cannot leave the cap just short of t.
  return origin_wall_ + std::chrono::duration_cast<WallTime::duration>(ahead) + std::chrono::nanoseconds(1);
}

SimTime Pacer::lateness(SimTime reached, WallTime now) const {
  if (paused_ || !rate_ || reached == kNever) return SimTime{0};
  return std::max(SimTime{0}, cap(now) - reached);
}

SimTime Pacer::slip(SimTime reached, WallTime now) {
  const SimTime late = lateness(reached, now);
  if (late <= slip_after_) return SimTime{0};
  origin_sim_ -= late;
  return late;
}

void Pacer::set_rate(std::optional<double> rate, SimTime reached, WallTime now) {
  origin_sim_ = reached;
  origin_wall_ = now;
  rate_ = rate;
}

void Pacer::begin_again() {
  started_ = false;
  origin_sim_ = SimTime{0};
  pause_cap_ = SimTime{-1};
}

void Pacer::pause(SimTime reached, WallTime now) { step_to(SimTime{-1}, reached, now); }

void Pacer::step_to(SimTime until, SimTime reached, WallTime now) {
  if (!paused_) {
    origin_sim_ = reached;
    origin_wall_ = now;
  }
  paused_ = true;
  pause_cap_ = until;
}

void Pacer::resume(WallTime now) {
  if (!paused_) return;
  paused_ = false;
  origin_sim_ = std::max(origin_sim_, pause_cap_);
  origin_wall_ = now;
}

}  // namespace ensonify::clock
