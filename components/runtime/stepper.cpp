#include "components/runtime/stepper.h"

#include <algorithm>
#include <tuple>

#include "components/errors/assert.h"
#include "components/runtime/peer.h"

namespace ensonify {

void Stepper::wire(std::vector<Feed> feeds, std::vector<OutTopic> outs, std::map<std::string, std::string> facts,
                   std::uint32_t epoch, std::uint32_t rank, Send send) {
  epoch_ = epoch;
  rank_ = rank;
  send_ = std::move(send);
  outs_ = std::move(outs);
  published_.assign(outs_.size(), 0);
  limits_.clear();
  for (const OutPort& out : ports_.outs()) limits_.emplace_back(out.rate);
  inlets_.clear();
  for (const Feed& feed : feeds) inlets_.push_back({feed, 0, {}});
  ports_.connect(std::move(feeds), std::move(facts), [this](std::size_t out, msg::Body body, msg::Buffer wall) {
    publish(out, std::move(body), std::move(wall));
  });
}

void Stepper::insert(const msg::Packet& packet) {
  for (Inlet& inlet : inlets_) {
    if (inlet.from.topic_id != packet.envelope.topic_id) continue;
    if (packet.envelope.seq != inlet.expected_seq)
      throw lost_messages(inlet.from.publisher, inlet.from.topic, inlet.expected_seq, packet.envelope.seq);
    ++inlet.expected_seq;
    inlet.waiting.push_back(packet);
  }
}

bool Stepper::too_late(const msg::Packet& packet) const {
  return std::any_of(inlets_.begin(), inlets_.end(), [&](const Inlet& inlet) {
    return inlet.from.topic_id == packet.envelope.topic_id &&
           SimTime{packet.envelope.t_sim_ns} + inlet.from.delay <= last_;
  });
}

void Stepper::deliver_due(SimTime now) {
  const auto key = [](const Inlet& inlet) {
    const msg::Envelope& e = inlet.waiting.front().envelope;
    return std::tuple(e.t_sim_ns, e.publisher, e.topic_id, e.seq, inlet.from.in_index);
  };
  while (true) {
    Inlet* first = nullptr;
    for (Inlet& inlet : inlets_) {
      if (inlet.waiting.empty()) continue;
      if (SimTime{inlet.waiting.front().envelope.t_sim_ns} + inlet.from.delay > now) continue;
      if (!first || key(inlet) < key(*first)) first = &inlet;
    }
    if (!first) return;
    const msg::Packet packet = std::move(first->waiting.front());
    first->waiting.pop_front();
    try {
      ports_.deliver(first->from.in_index, packet);
    } catch (const msg::DecodeError& e) {
      throw broken_message(first->from.publisher, first->from.topic, packet.envelope.seq, e.what());
    }
  }
}

bool Stepper::run_to(SimTime horizon) {
  while (next_ <= horizon) {
    const SimTime now = next_;
    last_ = now;
    ports_.begin_event(now);
    deliver_due(now);
    next_ = step_(now);
    ENSONIFY_ASSERT(next_ > now, ports_.process() + ": the event at " + std::to_string(now.count()) + " ns returned " +
                                     std::to_string(next_.count()) + " ns as the next event");
    ports_.end_event();
    if (ports_.finish_requested()) return true;
  }
  return false;
}

void Stepper::publish(std::size_t out_index, msg::Body body, msg::Buffer wall_facts) {
  const OutTopic& out = outs_[out_index];
  ENSONIFY_ASSERT(limits_[out_index].take(1, last_),
                  ports_.process() + "/" + ports_.outs()[out_index].port + ": " + limits_[out_index].text());
  msg::Packet packet;
  packet.topic = out.topic;
  packet.envelope.flags = wall_facts.size > 0 ? msg::kFlagWallFacts : std::uint16_t{0};
  packet.envelope.epoch = epoch_;
  packet.envelope.publisher = rank_;
  packet.envelope.topic_id = out.topic_id;
  packet.envelope.frame_count =
      static_cast<std::uint32_t>(msg::kFirstArrayFrame + body.arrays.size() + (wall_facts.size > 0 ? 1 : 0));
  packet.envelope.type_hash = msg::type_hash(ports_.outs()[out_index].type);
  packet.envelope.seq = published_[out_index]++;
  packet.envelope.t_sim_ns = last_.count();
  packet.body = std::move(body);
  packet.wall_facts = std::move(wall_facts);
  send_(std::move(packet));
}

}  // namespace ensonify
