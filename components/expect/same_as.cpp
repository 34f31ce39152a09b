#include "components/expect/same_as.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>

#include "components/errors/exit_error.h"
#include "components/record/reader.h"

namespace ensonify::expect {
namespace {

/// One message of the record, as it waits for its twin of the run.
struct Recorded {
  std::uint32_t seq = 0;
  SimTime t{0};
  msg::Buffer payload;
};

/// Compares the run with a record, message by message: time, sequence number, every byte. A record may hold every n-th
/// message of a topic (the recorder's `every`); the others then stay uncompared.
class SameAs : public Check {
 public:
  explicit SameAs(const Expectation& e) : reader_(e.record), wanted_(e.topics) {
    for (const auto& [id, channel] : reader_.channels()) {
      if (wants(channel.topic)) topics_[channel.topic];
    }
    for (const std::string& topic : wanted_) {
      if (!topics_.count(topic)) throw UserError("same_as: " + e.record + " has no topic " + topic);
    }
  }

  void see(const Observation& message) override {
    if (failed_) return;
    const std::string where = fmt::format("{} {} at {:.3f} s", message.topic(), message.seq(), seconds(message.t()));
    const Recorded* next = next_of(message.topic());
    Topic& topic = topics_.at(message.topic());
    const auto seq = static_cast<std::uint32_t>(message.seq());
    if (!next) {
      if (topic.whole) fail(message.t(), where + " is not in the record");
      return;
    }
    if (seq < next->seq) {
      topic.whole = false;
      return;
    }
    if (seq > next->seq) {
      fail(next->t,
           fmt::format("{} {} of the record at {:.3f} s did not come", message.topic(), next->seq, seconds(next->t)));
    } else if (next->t != message.t()) {
      fail(std::min(next->t, message.t()), fmt::format("{} has t = {:.9f} s in the record", where, seconds(next->t)));
    } else if (!msg::same_bytes(next->payload, msg::encode_inline(message.body()))) {
      fail(message.t(), where + " differs: " + difference(*next, message));
    }
    topic.waiting.pop_front();
    ++compared_;
  }

  Verdict close(SimTime end) override {
    if (failed_) return *failed_;
    for (auto& [name, topic] : topics_) {
      if (const Recorded* left = next_of(name)) {
        return {false, std::min(left->t, end),
                fmt::format("{} {} of the record at {:.3f} s did not come", name, left->seq, seconds(left->t))};
      }
    }
    if (!reader_.truncated().empty()) return {false, end, "the record is not whole: " + reader_.truncated()};
    if (compared_ == 0) return {false, end, "nothing was compared"};
    return {true, end, fmt::format("{} messages are equal", compared_)};
  }

  std::vector<std::string> topics() const override {
    std::vector<std::string> names;
    for (const auto& [name, topic] : topics_) names.push_back(name);
    return names;
  }
  std::vector<Field> fields() const override { return {}; }

 private:
  struct Topic {
    std::deque<Recorded> waiting;
    bool whole = true;  // no message of the run was missing in the record so far
  };

  bool wants(const std::string& topic) const {
    return wanted_.empty() || std::find(wanted_.begin(), wanted_.end(), topic) != wanted_.end();
  }

  void fail(SimTime t, std::string message) { failed_ = Verdict{false, t, std::move(message)}; }

  /// The next message of a topic, read on until there is one; messages of other topics on the way wait.
  const Recorded* next_of(const std::string& topic) {
    auto& waiting = topics_.at(topic).waiting;
    record::RecordedMessage message;
    while (waiting.empty() && reader_.next(message)) {
      const auto other = topics_.find(message.channel->topic);
      if (other != topics_.end()) other->second.waiting.push_back({message.seq, message.t_sim, message.payload});
    }
    return waiting.empty() ? nullptr : &waiting.front();
  }

  /// The first field that differs, by name.
  static std::string difference(const Recorded& recorded, const Observation& message) {
    const msg::Value was = msg::decode_inline(recorded.payload);
    const auto* fields = message.value().as<msg::Value::Map>();
    if (!fields) return "it is no map";
    for (const auto& [name, value] : *fields) {
      const msg::Value* before = was.find(name);
      if (!before) return name + " is not in the record";
      if (*before != value) {
        return fmt::format("{} is {}, in the record {}", name, msg::to_json(value, 4), msg::to_json(*before, 4));
      }
    }
    return "the record has more fields";
  }

  record::RecordReader reader_;
  std::vector<std::string> wanted_;
  std::map<std::string, Topic> topics_;
  std::optional<Verdict> failed_;
  std::int64_t compared_ = 0;
};

}  // namespace

std::unique_ptr<Check> make_same_as(const Expectation& expectation) { return std::make_unique<SameAs>(expectation); }

}  // namespace ensonify::expect
