#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/record/reader.h"
#include "components/runtime/declared.h"
#include "messages/declarations.h"
#include "tools/console/source.h"

namespace ensonify::console {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr const char* kScenarioName = "scenario.yaml";  // of a record's attachments

/// Adds to an integer of a message.
void shift(msg::Value& message, std::string_view key, std::int64_t by) {
  auto* map = std::get_if<msg::Value::Map>(&message.is);
  if (map == nullptr) return;
  for (msg::MapEntry& entry : *map) {
    auto* number = std::get_if<std::int64_t>(&entry.second.is);
    if (entry.first == key && number != nullptr) *number += by;
  }
}

/// Plays a record at its own pace. It stands still while nobody watches.
class RecordSource : public Source {
 public:
  RecordSource(std::string file, const RecordOptions& options)
      : file_(std::move(file)), options_(options), speed_(options.speed) {
    rewind();
    read_next();  // records of other writers name their topics among the messages
    for (const record::Attachment& attachment : reader_->attachments()) {
      if (attachment.name == record::kDeclarationsName) heads_ = declared<msg::HeadDeclaration>(attachment.data);
    }
    topics_.clear();  // listed as they were read, before it was known what publishes them
    list_topics();
  }

  msg::ConsoleState state() const override {
    msg::ConsoleState state;
    state.kind = "record";
    state.name = file_;
    state.state = ended_ ? "ended" : paused_ ? "paused" : "running";
    state.message = message_;
    state.speed = speed_;
    state.topics = topics_;
    return state;
  }

  std::string beam_axis(const std::string& publisher) const override {
    const auto head = heads_.find(publisher);
    return head == heads_.end() ? "down" : head->second.beam_axis;
  }

  std::string scenario() const override {
    for (const record::Attachment& attachment : reader_->attachments())
      if (attachment.name == kScenarioName) return attachment.data;
    return "";
  }

  std::string folder() const override { return std::filesystem::absolute(file_).parent_path().string(); }

  void want(const std::set<std::string>& topics) override {
    const bool rested = wanted_.empty();
    wanted_ = topics;
    if (rested) anchor_.reset();
  }

  void poll(WallTime now, milliseconds budget, const Take& take) override {
    if (wanted_.empty() || paused_ || ended_) return;
    const WallTime until = now + budget;
    while (steady_clock::now() < until) {
      if (!next_ && !read_next()) return;
      if (!anchor_) anchor_ = {now, time_of(*next_)};
      if (speed_ > 0.0) {
        const double due_s = 1e-9 * static_cast<double>(time_of(*next_) - anchor_->second) / speed_;
        if (std::chrono::duration<double>(steady_clock::now() - anchor_->first).count() < due_s) return;
      }
      const record::RecordedMessage message = std::move(*next_);
      next_.reset();
      if (wanted_.contains(message.channel->topic)) take(packet_of(message));
    }
  }

  void command(const msg::ConsoleCommand& command) override {
    if (command.command == "pause") paused_ = true;
    else if (command.command == "resume") paused_ = false;
    else if (command.command == "rate") speed_ = command.rate;
    else if (command.command == "stop") ended_ = true;
    anchor_.reset();
  }

 private:
  std::int64_t time_of(const record::RecordedMessage& message) const { return message.t_sim.count() + shift_ns_; }

  void list_topics() {
    if (topics_.size() == reader_->channels().size()) return;
    topics_.clear();
    for (const auto& [id, channel] : reader_->channels()) {
      const std::string publisher = channel.topic.substr(0, channel.topic.find('/'));
      const auto head = heads_.find(publisher);
      topics_.push_back({channel.topic, channel.type, publisher, head == heads_.end() ? "" : head->second.kind});
    }
  }

  void rewind() {
    next_.reset();
    reader_ = std::make_unique<record::RecordReader>(file_);
  }

  bool read_next() {
    record::RecordedMessage message;
    if (!reader_->next(message)) {
      message_ = reader_->truncated();
      if (options_.loop && newest_ns_ && message_.empty()) return begin_again();
      ended_ = true;
      return false;
    }
    newest_ns_ = std::max(newest_ns_.value_or(INT64_MIN), message.t_sim.count());
    if (!oldest_ns_) oldest_ns_ = message.t_sim.count();
    next_ = std::move(message);
    if (reader_->channels().size() > topics_.size()) list_topics();
    return true;
  }

  /// Times and numbers go on behind the last.
  bool begin_again() {
    constexpr std::int64_t kGap_ns = 100'000'000;
    shift_ns_ += *newest_ns_ - *oldest_ns_ + kGap_ns;
    for (auto& [topic, numbers] : numbers_) {
      numbers.seq_shift = numbers.next_seq;
      numbers.ping_shift = numbers.next_ping;
    }
    rewind();
    return read_next();
  }

  msg::Packet packet_of(const record::RecordedMessage& message) {
    const record::Channel& channel = *message.channel;
    msg::Value value = msg::decode_inline(message.payload);
    Numbers& numbers = numbers_[channel.topic];
    if (shift_ns_ != 0) {
      shift(value, "stamp_ns", shift_ns_);
      shift(value, "ping", numbers.ping_shift);
    }
    if (const msg::Value* ping = value.find("ping"))
      if (const auto* number = ping->as<std::int64_t>()) numbers.next_ping = *number + 1;
    msg::Packet packet;
    packet.topic = channel.topic;
    packet.envelope.epoch = 1;
    packet.envelope.publisher = channel.rank;
    packet.envelope.topic_id = channel.id;
    packet.envelope.type_hash = msg::type_hash(channel.type);
    packet.envelope.seq = message.seq + numbers.seq_shift;
    packet.envelope.t_sim_ns = time_of(message);
    numbers.next_seq = packet.envelope.seq + 1;
    packet.body = msg::encode_value(value);
    return packet;
  }

  struct Numbers {
    std::uint64_t next_seq = 0;
    std::uint64_t seq_shift = 0;
    std::int64_t next_ping = 0;
    std::int64_t ping_shift = 0;
  };

  std::string file_;
  RecordOptions options_;
  double speed_;
  bool paused_ = false;
  bool ended_ = false;
  std::string message_;
  std::vector<msg::ConsoleTopic> topics_;
  std::map<std::string, msg::HeadDeclaration> heads_;
  std::set<std::string> wanted_;
  std::unique_ptr<record::RecordReader> reader_;
  std::optional<record::RecordedMessage> next_;
  std::optional<std::pair<WallTime, std::int64_t>> anchor_;  // wall and sim time at which this stretch began
  std::optional<std::int64_t> oldest_ns_;
  std::optional<std::int64_t> newest_ns_;
  std::int64_t shift_ns_ = 0;
  std::map<std::string, Numbers> numbers_;
};

}  // namespace

std::unique_ptr<Source> record_source(const std::string& file, const RecordOptions& options) {
  return std::make_unique<RecordSource>(file, options);
}

}  // namespace ensonify::console
