#include "components/sonar/ping_clock.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/runtime/log.h"

namespace ensonify {
namespace {

/// Beats are rounded down to nanoseconds: two of one rate may lie that much closer than its period.
constexpr SimTime kRounding = std::chrono::microseconds(1);

SimTime period(Rate rate) { return rate.num > 0 ? event_time(1, rate) - kRounding : SimTime{0}; }

}  // namespace

PingClock::PingClock(Ports& ports, const PingTiming& timing)
    : ports_(ports), trigger_(timing.trigger), rate_(timing.rate), dead_time_(timing.dead_time) {
  if (trigger_.mode == Trigger::Mode::kInterleaved) phase_ = next_ = from_seconds(trigger_.slot_s);
  if (trigger_.mode == Trigger::Mode::kSlave) {
    ports.in<msg::Transmit>("trigger", [this](const msg::Transmit& master) { follow(master); });
  }
}

bool PingClock::due(SimTime now) { return trigger_.mode == Trigger::Mode::kSlave ? follows_now(now) : next_ <= now; }

SimTime PingClock::next() const {
  if (trigger_.mode != Trigger::Mode::kSlave) return next_;
  return to_follow_.empty() ? poll_ : std::min(poll_, to_follow_.front());
}

void PingClock::set_rate(Rate rate) {
  if (rate == rate_) return;
  rate_ = rate;
  if (trigger_.mode != Trigger::Mode::kFree) return;
  phase_ = next_;
  beat_ = 0;
}

void PingClock::transmitted(SimTime now, SimTime reception) {
  free_ = now + reception + dead_time_;
  if (trigger_.mode == Trigger::Mode::kFree) {
    advance();
    if (next_ >= free_) return;
    phase_ = next_ = free_;
    beat_ = 0;
    return;
  }
  free_ = std::max(free_, now + period(rate_));
  if (trigger_.mode == Trigger::Mode::kInterleaved) {
    do advance();
    while (next_ < free_);
  }
}

void PingClock::skipped() {
  if (trigger_.mode != Trigger::Mode::kSlave) advance();
}

SimTime PingClock::intended() const {
  if (trigger_.mode != Trigger::Mode::kSlave) return next_;
  if (!to_follow_.empty()) return to_follow_.front();
  return expected_ ? *expected_ + from_seconds(trigger_.offset_s) : SimTime{0};
}

void PingClock::advance() {
  ++beat_;
  next_ = trigger_.mode == Trigger::Mode::kInterleaved ? phase_ + beat_ * from_seconds(trigger_.cycle_s)
                                                       : event_time(beat_, rate_, phase_);
}

void PingClock::follow(const msg::Transmit& master) {
  const SimTime at{master.stamp_ns};
  if (at <= followed_ || master.ping == followed_ping_) return;  // another frequency or sector of the same ping
  followed_ = at;
  followed_ping_ = master.ping;
  to_follow_.push_back(at + from_seconds(trigger_.offset_s));
  expected_.reset();
  if (master.next_ns > master.stamp_ns) poll_ = *(expected_ = SimTime{master.next_ns});
}

bool PingClock::follows_now(SimTime now) {
  if (poll_ <= now) poll_ = now + kPoll;
  std::optional<SimTime> wanted;
  for (; !to_follow_.empty() && to_follow_.front() <= now; to_follow_.pop_front()) {
    if (wanted || now < free_) ports_.count("triggers_missed");
    else wanted = to_follow_.front();
  }
  if (wanted && *wanted < now) {
    ports_.count("triggers_late");
    log::event(ports_, "trigger_late", "by_s={:.6f}", seconds(now - *wanted));
  }
  if (!wanted && to_follow_.empty()) report_missing(now);
  return wanted.has_value();
}

void PingClock::report_missing(SimTime now) {
  if (now - std::max(followed_, SimTime{0}) <= from_seconds(trigger_.patience_s)) return;
  ports_.health("degraded", followed_ < SimTime{0}
                                ? "this head is a slave, and its master has not transmitted"
                                : fmt::format("the master has not transmitted since {:.3f} s", seconds(followed_)));
}

}  // namespace ensonify
