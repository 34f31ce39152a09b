#include "tests/support/stub/node.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <numeric>
#include <stdexcept>
#include <thread>

namespace ensonify {
namespace {

void sleep_for(double ms) { std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(ms)); }

}  // namespace

StubNode::StubNode(const Config& config, Ports& ports)
    : config_(config), ports_(ports), events_({config.rate_hz, 1}), wall_jitter_(static_cast<std::uint64_t>(getpid())) {
  for (const Config::Out& out : config.outs) {
    const auto max_bytes = static_cast<std::size_t>(out.bytes) + 1024;
    msg::Array<std::uint8_t> filler({static_cast<std::size_t>(out.bytes)});
    std::fill(filler.flat().begin(), filler.flat().end(), std::uint8_t{0x5A});
    const std::size_t port = ports.declare_out({out.port, out.type, max_bytes, {out.hz, 1}});
    outs_.push_back({port, Periodic({out.hz, 1}), filler});
  }
  for (const Config::In& in : config.ins) {
    ports.in_raw(in.port, in.type, [this](const msg::Packet& packet) { take(packet); },
                 {.delay = from_seconds(in.delay_ms * 1e-3)});
  }
  if (config.finish_s) ports.may_finish();
}

void StubNode::take(const msg::Packet& packet) {
  ++received_;
  const msg::Envelope& e = packet.envelope;
  for (const std::uint64_t part :
       {static_cast<std::uint64_t>(e.t_sim_ns), std::uint64_t{e.publisher}, std::uint64_t{e.topic_id}, e.seq}) {
    digest_ = (digest_ ^ part) * 0x100000001b3U;
  }
  if (!config_.read_every_byte) return;
  for (const msg::Buffer& array : packet.body.arrays) {
    for (const std::byte b : array.bytes()) byte_sum_ += std::to_integer<std::uint64_t>(b);
  }
}

SimTime StubNode::step(SimTime now) {
  events_.due(now);
  if (now == SimTime{0}) sleep_for(config_.first_ms);
  pause_at_random();
  misbehave(now);
  for (Output& out : outs_) {
    if (!out.due.due(now)) continue;
    const Blob blob{now.count(), received_, digest_, out.filler};
    ports_.publish(out.index, msg::encode(blob));
  }
  if (config_.finish_s && now >= from_seconds(*config_.finish_s)) ports_.finish();
  return events_.next();
}

void StubNode::misbehave(SimTime now) {
  const auto due = [now](const std::optional<double>& at_s) { return at_s && now >= from_seconds(*at_s); };
  if (due(config_.throw_s)) throw std::runtime_error(ports_.process() + ": told to throw");
  if (due(config_.die_s)) std::raise(SIGKILL);
  if (due(config_.stop_s)) std::raise(SIGSTOP);
  volatile std::uint64_t busy = 0;
  while (due(config_.spin_s)) busy = busy + 1;
}

/// Disturbs the order in which messages arrive; results must not notice.
void StubNode::pause_at_random() {
  if (config_.jitter_ms <= 0.0) return;
  sleep_for(std::uniform_real_distribution<double>(0.0, config_.jitter_ms)(wall_jitter_));
}

}  // namespace ensonify
