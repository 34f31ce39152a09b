#include "components/record/compare.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <deque>
#include <map>
#include <tuple>

#include "components/record/bytes.h"
#include "components/record/value_difference.h"
#include "components/runtime/ports.h"
#include "messages/codec.h"

namespace ensonify::record {
namespace {

/// A message that waits for its partner. The payload is only kept as long as it may be the first difference.
struct Waiting {
  SimTime t_sim{0};
  std::uint32_t seq = 0;
  std::size_t size = 0;
  std::uint32_t crc = 0;
  msg::Buffer payload;
};

struct Topic {
  TopicComparison counts;
  std::tuple<std::uint32_t, std::uint16_t> order;  // rank, id
  std::deque<Waiting> a;
  std::deque<Waiting> b;
};

std::string time_text(SimTime t) { return std::to_string(t.count()); }

class Comparer {
 public:
  Comparer(RecordReader& a, RecordReader& b, const std::vector<std::string>& patterns)
      : a_(a), b_(b), patterns_(patterns) {}

  Comparison run() {
    RecordedMessage from_a, from_b;
    bool more_a = a_.next(from_a);
    bool more_b = b_.next(from_b);
    while (more_a || more_b) {  // whichever is behind in sim time moves on
      if (more_a && (!more_b || from_a.t_sim <= from_b.t_sim)) {
        take(from_a, true);
        more_a = a_.next(from_a);
      } else {
        take(from_b, false);
        more_b = b_.next(from_b);
      }
    }
    for (auto& [name, topic] : topics_) {
      for (const Waiting& lost : topic.a) only_in_a(topic, lost);
      for (const Waiting& added : topic.b) only_in_b(topic, added);
    }
    note_facts();
    return result();
  }

 private:
  void take(const RecordedMessage& message, bool is_a) {
    const Channel& channel = *message.channel;
    if (!wanted(channel.topic)) return;
    Topic& topic = topic_of(channel);
    ++(is_a ? topic.counts.a : topic.counts.b);
    Waiting waiting{message.t_sim, message.seq, message.payload.size, 0, message.payload};
    if (first_) {
      waiting.crc = crc32(message.payload.bytes());
      waiting.payload = {};
    }
    auto& queue = is_a ? topic.a : topic.b;
    // What still waits is behind the other record's sim time: its partner, if any, has another time and thus differs.
    if (!queue.empty() && queue.back().t_sim < message.t_sim) queue.back().payload = {};
    queue.push_back(std::move(waiting));
    match(topic);
  }

  bool wanted(const std::string& topic) const {
    return patterns_.empty() ||
           std::any_of(patterns_.begin(), patterns_.end(), [&](const auto& p) { return topic_matches(p, topic); });
  }

  Topic& topic_of(const Channel& channel) {
    const auto [found, is_new] = topics_.try_emplace(channel.topic);
    if (is_new) {
      found->second.counts.topic = channel.topic;
      found->second.order = {channel.rank, channel.id};
    }
    return found->second;
  }

  /// Pairs what can be paired. Sequence numbers rise, so a smaller one in front has no partner.
  void match(Topic& topic) {
    while (!topic.a.empty() && !topic.b.empty()) {
      const Waiting& a = topic.a.front();
      const Waiting& b = topic.b.front();
      if (a.seq < b.seq) {
        only_in_a(topic, a);
        topic.a.pop_front();
      } else if (b.seq < a.seq) {
        only_in_b(topic, b);
        topic.b.pop_front();
      } else {
        compare_pair(topic, a, b);
        topic.a.pop_front();
        topic.b.pop_front();
      }
    }
  }

  void only_in_a(Topic& topic, const Waiting& message) {
    ++topic.counts.only_a;
    consider(topic, {message.t_sim, topic.counts.topic, message.seq, "", "there", "missing"});
  }
  void only_in_b(Topic& topic, const Waiting& message) {
    ++topic.counts.only_b;
    consider(topic, {message.t_sim, topic.counts.topic, message.seq, "", "missing", "there"});
  }

  void compare_pair(Topic& topic, const Waiting& a, const Waiting& b) {
    Difference found{a.t_sim, topic.counts.topic, a.seq, "", "", ""};
    if (a.t_sim != b.t_sim) {
      std::tie(found.field, found.a, found.b) = std::tuple("t_sim_ns", time_text(a.t_sim), time_text(b.t_sim));
    } else if (a.payload.owner && b.payload.owner) {
      if (msg::same_bytes(a.payload, b.payload)) return;
      describe(a.payload, b.payload, found);
    } else {  // after the first difference only the number of others counts
      if (a.size == b.size && checksum(a) == checksum(b)) return;
      found.field = "payload";
    }
    ++topic.counts.differing;
    consider(topic, std::move(found));
  }

  static std::uint32_t checksum(const Waiting& message) {
    return message.payload.owner ? crc32(message.payload.bytes()) : message.crc;
  }

  static void describe(const msg::Buffer& a, const msg::Buffer& b, Difference& found) {
    try {
      if (const auto difference = first_difference(msg::decode_inline(a), msg::decode_inline(b))) {
        std::tie(found.field, found.a, found.b) = std::tie(difference->field, difference->a, difference->b);
        return;
      }
    } catch (const msg::DecodeError&) {  // what cannot be decoded is compared as bytes
    }
    found.field = "payload";
    found.a = std::to_string(a.size) + " bytes";
    found.b = std::to_string(b.size) + " bytes, encoded differently";
  }

  /// Keeps the earlier one.
  void consider(const Topic& topic, Difference found) {
    const std::tuple key(found.t_sim, topic.order, found.seq);
    if (first_ && key >= first_key_) return;
    first_ = std::move(found);
    first_key_ = key;
  }

  void note_facts() {
    const auto note = [this](const std::string& text) { notes_.push_back(text); };
    if (!a_.truncated().empty()) note("A ends early " + a_.truncated());
    if (!b_.truncated().empty()) note("B ends early " + b_.truncated());
    if (a_.info().utc_start_ns != b_.info().utc_start_ns) note("the runs start at different UTC times");
    for (const Attachment& attachment : a_.attachments()) {
      const auto& others = b_.attachments();
      const auto other =
          std::find_if(others.begin(), others.end(), [&](const auto& o) { return o.name == attachment.name; });
      if (other == others.end()) note("only A holds " + attachment.name);
      else if (other->data != attachment.data) note(attachment.name + " differs");
    }
    for (const auto& [id, channel] : a_.channels()) {
      for (const auto& [other_id, other] : b_.channels()) {
        if (other.topic != channel.topic || !wanted(channel.topic)) continue;
        if (other.type != channel.type) note(channel.topic + " is " + channel.type + " in A, " + other.type + " in B");
      }
    }
  }

  Comparison result() {
    Comparison comparison{std::move(first_), {}, std::move(notes_)};
    std::vector<const Topic*> ordered;
    for (const auto& [name, topic] : topics_) ordered.push_back(&topic);
    std::sort(ordered.begin(), ordered.end(), [](const Topic* x, const Topic* y) {
      return std::tie(x->order, x->counts.topic) < std::tie(y->order, y->counts.topic);
    });
    for (const Topic* topic : ordered) comparison.topics.push_back(topic->counts);
    return comparison;
  }

  RecordReader& a_;
  RecordReader& b_;
  const std::vector<std::string>& patterns_;
  std::map<std::string, Topic> topics_;
  std::optional<Difference> first_;
  std::tuple<SimTime, std::tuple<std::uint32_t, std::uint16_t>, std::uint32_t> first_key_;
  std::vector<std::string> notes_;
};

}  // namespace

Comparison compare(RecordReader& a, RecordReader& b, const std::vector<std::string>& topics) {
  return Comparer(a, b, topics).run();
}

}  // namespace ensonify::record
