#include "components/sonar/ping_cycle.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/runtime/log.h"
#include "components/sonar/sea_acoustics.h"

namespace ensonify {
namespace {

/// Beats are rounded down to nanoseconds: two of one rate may lie that much closer than its period.
constexpr SimTime kRounding = std::chrono::microseconds(1);

SimTime period(Rate rate) { return rate.num > 0 ? event_time(1, rate) - kRounding : SimTime{0}; }

constexpr std::int64_t kMostTransmissions = 16;  // of a ping: its sectors or channels

}  // namespace

Interference::Interference(Ports& ports, const HeadInputs& inputs, const std::vector<OtherHead>& others,
                           SimTime latency)
    : inputs_(inputs), others_(others) {
  if (others_.empty()) return;
  std::vector<std::string> topics;
  for (const OtherHead& other : others_) topics.push_back(other.process + "/transmit");
  ports.in_topics<msg::Transmit>(
      "transmits", topics,
      [this](const std::string& publisher, const msg::Transmit& sent) {
        const auto from = std::find_if(others_.begin(), others_.end(),
                                       [&](const OtherHead& other) { return other.process == publisher; });
        received_.push_back({&*from, sent});
        while (!inputs_.truth().empty() && received_.front().sent.stamp_ns < inputs_.truth().oldest_ns())
          received_.pop_front();
      },
      {.delay = latency});
}

std::vector<echo::InterferingTransmission> Interference::during(SimTime transmit, SimTime reception) const {
  std::vector<echo::InterferingTransmission> transmissions;
  if (received_.empty()) return transmissions;
  const auto pose_at = [&](std::int64_t t_ns) {
    return *inputs_.truth().at(t_ns, frames::PoseHistory::Outside::kNearest);
  };
  const auto altitude =
      altitude_m(inputs_.seabed(), frames::head_pose(pose_at(transmit.count()), inputs_.mounting().actual));
  for (const auto& [from, sent] : received_) {
    if (SimTime{sent.stamp_ns} > transmit + reception) continue;
    echo::InterferingTransmission transmission;
    transmission.time_s = seconds(SimTime{sent.stamp_ns} - transmit);
    transmission.source_enu_m = pose_at(sent.stamp_ns).enu_from_body * from->from_us_body_m;
    transmission.source_level_db = sent.source_level_db - from->isolation_db;
    transmission.frequency_hz = sent.frequency_hz;
    transmission.sweep_hz = sent.bandwidth_hz;
    transmission.duration_s = sent.pulse_length_s;
    transmission.rejection_db = from->rejection_db;
    transmissions.push_back(transmission);
    if (!altitude) continue;
    transmission.source_enu_m.z() = -2.0 * *altitude - transmission.source_enu_m.z();
    transmission.source_level_db = sent.source_level_db - from->bottom_loss_db;
    transmissions.push_back(transmission);
  }
  return transmissions;
}

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

PingCycle::PingCycle(Ports& ports, const HeadInputs& inputs, const PingTiming& timing)
    : ports_(ports),
      inputs_(inputs),
      processing_latency_(timing.processing_latency),
      clock_(ports, timing),
      others_(ports, inputs, timing.others, timing.processing_latency),
      transmit_out_(
          ports.out<msg::Transmit>("transmit", {.rate = {kMostTransmissions * timing.rate.num, timing.rate.den}})) {}

std::optional<PingUnderWay> PingCycle::ready(SimTime now) {
  if (under_way_.empty() || under_way_.front().ready > now) return std::nullopt;
  PingUnderWay ping = std::move(under_way_.front());
  under_way_.pop_front();
  ping.interfering = others_.during(ping.transmit, ping.ready - processing_latency_ - ping.transmit);
  return ping;
}

bool PingCycle::may_transmit(SimTime now) {
  if (!clock_.due(now)) return false;
  const std::string obstacle = inputs_.obstacle(now);
  if (obstacle.empty()) {
    if (const auto spell = silence_.end()) {
      log::event(ports_, "pings_again", "after_s={:.3f} passed_over={}", seconds(now - spell->since),
                 spell->passed_over);
    }
    return true;
  }
  clock_.skipped();
  if (silence_.pass_over(now, obstacle)) log::event(ports_, "no_ping", "why=\"{}\"", obstacle);
  ports_.count("pings_skipped");
  ports_.health("degraded", obstacle);
  return false;
}

void PingCycle::transmit(SimTime now, std::vector<Transmission> channels) {
  SimTime reception{0};
  for (const Transmission& channel : channels) reception = std::max(reception, channel.reception);
  clock_.set_rate(rate_of(channels.front().settings.ping_rate_hz));
  clock_.transmitted(now, reception);
  std::vector<const Transmission*> in_time;
  for (const Transmission& channel : channels) in_time.push_back(&channel);
  std::ranges::stable_sort(in_time, {}, [](const Transmission* channel) { return channel->delay; });
  for (const Transmission* sent : in_time) {
    const Transmission& channel = *sent;
    msg::Transmit transmit;
    transmit.stamp_ns = (now + channel.delay).count();
    transmit.ping = pings_;
    transmit.frequency_hz = channel.frequency_hz;
    transmit.pulse_length_s = channel.pulse_length_s;
    transmit.bandwidth_hz = channel.bandwidth_hz;
    transmit.source_level_db = channel.settings.source_level_db;
    transmit.next_ns = clock_.intended().count();
    transmit_out_.send(transmit);
  }
  under_way_.push_back({pings_++, now, std::move(channels), now + reception + processing_latency_});
}

void PingCycle::published(const std::string& trouble) {
  ports_.count("pings");
  if (!trouble.empty()) return ports_.health("degraded", trouble);
  if (inputs_.estimate().empty()) {
    return ports_.health("degraded", "no navigation estimate has arrived: pings have no track");
  }
  ports_.health("ok", "");
}

SimTime PingCycle::next() const {
  return under_way_.empty() ? clock_.next() : std::min(clock_.next(), under_way_.front().ready);
}

}  // namespace ensonify
