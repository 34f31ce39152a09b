#include "components/runtime/stepper.h"

#include <algorithm>
#include <tuple>

#include "components/errors/assert.h"
#include "components/runtime/peer.h"
#include "components/runtime/wiring.h"

namespace ensonify {

void Stepper::wire(std::vector<Feed> feeds, std::vector<OutTopic> outs, std::map<std::string, std::string> facts,
                   std::uint32_t epoch, std::uint32_t rank, Send send, Viewers viewers) {
  epoch_ = epoch;
  rank_ = rank;
  send_ = std::move(send);
  viewers_ = std::move(viewers);
  outs_ = std::move(outs);
  published_.assign(outs_.size(), 0);
  limits_.clear();
  for (const OutPort& out : ports_.outs()) limits_.emplace_back(out.rate);
  inlets_.clear();
  unusable_.clear();
  for (const Feed& feed : feeds) inlets_.push_back({feed, 0, {}});
  const auto publish_it = [this](std::size_t out, msg::Body body, msg::Buffer wall) {
    publish(out, std::move(body), std::move(wall));
  };
  ports_.connect(std::move(feeds), std::move(facts), publish_it, live_plane());
}

/// Nothing of it is counted in published(), limited or injected: no participant knows of it.
LivePlane Stepper::live_plane() {
  lives_.clear();
  for (const LivePort& port : ports_.lives()) lives_.push_back({ports_.process() + "/" + port.port, kNoTopicId});
  shown_.assign(lives_.size(), 0);
  if (!viewers_.send) return {};
  const auto watched = [this](std::size_t i) { return viewers_.watched(lives_[i].topic); };
  const auto show = [this](std::size_t i, msg::Body body) {
    viewers_.send(packet_of(lives_[i], ports_.lives()[i].type, shown_[i]++, std::move(body), {}));
  };
  return {watched, show, viewers_.late};
}

void Stepper::insert(const msg::Packet& packet) {
  for (Inlet& inlet : inlets_) {
    if (inlet.from.topic_id != packet.envelope.topic_id || inlet.closed) continue;
    if (packet.envelope.seq != inlet.expected_seq && inlet.ending) continue;
    if (packet.envelope.seq != inlet.expected_seq)
      throw lost_messages(inlet.from.publisher, inlet.from.topic, inlet.expected_seq, packet.envelope.seq);
    ++inlet.expected_seq;
    inlet.waiting.push_back(packet);
  }
}

void Stepper::close(std::uint32_t topic_id, SimTime t, const PeerError& why) {
  for (Inlet& inlet : inlets_) {
    if (inlet.from.topic_id == topic_id && !inlet.closed && !inlet.ending) inlet.ending = Ending{t, why};
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
    if (!first) return close_due(now);
    const msg::Packet packet = std::move(first->waiting.front());
    first->waiting.pop_front();
    deliver(*first, packet, now);
  }
}

void Stepper::deliver(Inlet& inlet, const msg::Packet& packet, SimTime now) {
  try {
    ports_.deliver(inlet.from.in_index, packet);
  } catch (const msg::DecodeError& e) {
    const PeerError why = broken_message(inlet.from.publisher, inlet.from.topic, packet.envelope.seq, e.what());
    if (!inlet.from.may_be_lost) throw PeerError(why);
    inlet.waiting.clear();
    inlet.ending = Ending{now - inlet.from.delay, why};
  }
}

void Stepper::close_due(SimTime now) {
  for (Inlet& inlet : inlets_) {
    if (!inlet.ending || inlet.ending->t + inlet.from.delay > now) continue;
    unusable_.push_back({now, inlet.ending->why});
    inlet.ending.reset();
    inlet.closed = true;
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
  send_(packet_of(out, ports_.outs()[out_index].type, published_[out_index]++, std::move(body), std::move(wall_facts)));
}

msg::Packet Stepper::packet_of(const OutTopic& topic, const std::string& type, std::uint64_t seq, msg::Body body,
                               msg::Buffer wall_facts) const {
  msg::Packet packet;
  packet.topic = topic.topic;
  packet.envelope.flags = wall_facts.size > 0 ? msg::kFlagWallFacts : std::uint16_t{0};
  packet.envelope.epoch = epoch_;
  packet.envelope.publisher = rank_;
  packet.envelope.topic_id = topic.topic_id;
  packet.envelope.frame_count =
      static_cast<std::uint32_t>(msg::kFirstArrayFrame + body.arrays.size() + (wall_facts.size > 0 ? 1 : 0));
  packet.envelope.type_hash = msg::type_hash(type);
  packet.envelope.seq = seq;
  packet.envelope.t_sim_ns = last_.count();
  packet.body = std::move(body);
  packet.wall_facts = std::move(wall_facts);
  return packet;
}

}  // namespace ensonify
