#include "tools/record/live.h"

namespace ensonify::record_tool {

LiveOrder::LiveOrder(Write write, SimTime hold, std::size_t most_bytes)
    : write_(std::move(write)), hold_(hold), most_bytes_(most_bytes) {}

void LiveOrder::take(msg::Packet packet) {
  const msg::Envelope& envelope = packet.envelope;
  const auto [entry, first] = kept_.try_emplace(packet.topic);
  Kept& kept = entry->second;
  if (!first && envelope.seq > kept.next_seq) kept.missed += envelope.seq - kept.next_seq;
  kept.next_seq = envelope.seq + 1;
  const Place place{envelope.t_sim_ns, envelope.publisher, envelope.topic_id, envelope.seq};
  if (place < written_to_) {
    ++kept.missed;
    return;
  }
  ++kept.received;
  newest_ns_ = std::max(newest_ns_, envelope.t_sim_ns);
  held_bytes_ += packet.body.size();
  held_.emplace(place, std::move(packet));
  while (!held_.empty() &&
         (held_bytes_ > most_bytes_ || std::get<0>(held_.begin()->first) < newest_ns_ - hold_.count()))
    write_first();
}

void LiveOrder::write_first() {
  const auto first = held_.begin();
  written_to_ = first->first;
  held_bytes_ -= first->second.body.size();
  write_(first->second);
  held_.erase(first);
}

void LiveOrder::finish() {
  while (!held_.empty()) write_first();
}

}  // namespace ensonify::record_tool
