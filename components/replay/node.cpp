#include "components/replay/node.h"

#include <algorithm>
#include <deque>

#include "components/config/config_error.h"
#include "components/errors/exit_error.h"
#include "components/errors/nearest_name.h"
#include "components/runtime/ports.h"

namespace ensonify {
namespace {

constexpr const char* kHealthPort = "health";  // every process has its own

/// What a port must be able to carry.
struct Load {
  std::size_t max_bytes = 0;
  std::int64_t most_per_second = 0;
  std::deque<SimTime> last_second;

  void add(const record::RecordedMessage& message) {
    max_bytes = std::max(max_bytes, message.payload.size);  // the arrays are inside: an upper bound of the body
    while (!last_second.empty() && last_second.front() <= message.t_sim - 1_s) last_second.pop_front();
    last_second.push_back(message.t_sim);
    most_per_second = std::max(most_per_second, static_cast<std::int64_t>(last_second.size()));
  }
};

bool any_matches(const std::vector<std::string>& patterns, const std::string& topic) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& p) { return topic_matches(p, topic); });
}

std::string with_place(const std::string& place, const std::string& text) {
  return place.empty() ? text : place + ": " + text;
}

}  // namespace

ReplayNode::ReplayNode(const Config& config, Ports& ports) : config_(config), ports_(ports), reader_(config.file) {
  declare_ports();
  declare_again();
  check_topics();
  if (config_.finish) ports_.may_finish();
  has_next_ = read_next();
}

std::string ReplayNode::port_of(const std::string& topic) const {
  if (const auto renamed = config_.rename.find(topic); renamed != config_.rename.end()) return renamed->second;
  const std::string own = ports_.process() + "/";
  return topic.starts_with(own) ? topic.substr(own.size()) : topic;
}

void ReplayNode::declare_ports() {
  std::map<std::uint16_t, Load> loads;
  record::RecordReader whole(config_.file);
  for (record::RecordedMessage message; whole.next(message);) {
    if (message.t_sim < SimTime{0})
      throw UserError(with_place(config_.file_place, config_.file + ": holds sim times below 0"));
    loads[message.channel->id].add(message);
  }
  for (const auto& [id, channel] : whole.channels()) {
    const bool wanted = any_matches(config_.topics, channel.topic);
    const std::string port = port_of(channel.topic);
    if (!wanted || port == kHealthPort) continue;
    const Load& load = loads[id];
    out_of_[id] = ports_.declare_out({port, channel.type, std::max(channel.max_bytes, load.max_bytes),
                                      Rate{std::max<std::int64_t>(load.most_per_second, 1), 1}});
  }
}

/// What the recorded process of this name declared.
void ReplayNode::declare_again() {
  for (const record::Attachment& file : reader_.attachments()) {
    if (file.name != record::kDeclarationsName) continue;
    const msg::Value all = msg::from_json(file.data);
    const msg::Value* own = all.find(ports_.process());
    const auto* types = own == nullptr ? nullptr : own->as<msg::Value::Map>();
    if (types == nullptr) continue;
    for (const auto& [type, content] : *types) ports_.declare(type, content);
  }
}

void ReplayNode::check_topics() const {
  std::vector<std::string> recorded;
  for (const auto& [id, channel] : reader_.channels()) recorded.push_back(channel.topic);
  const auto check = [&](const std::string& topic, const std::string& place) {
    const bool found =
        std::any_of(recorded.begin(), recorded.end(), [&](const std::string& r) { return topic_matches(topic, r); });
    if (found) return;
    const std::string near = nearest_name(topic, recorded);
    throw UserError(with_place(place, "the record " + config_.file + " holds no " + topic +
                                          (near.empty() ? "" : " (did you mean " + near + "?)")));
  };
  for (const std::string& topic : config_.topics) check(topic, config_.topics_place);
  for (const auto& [topic, port] : config_.rename) check(topic, config_.file_place);
}

bool ReplayNode::read_next() {
  while (reader_.next(next_)) {
    if (out_of_.count(next_.channel->id) > 0) return true;
  }
  return false;
}

SimTime ReplayNode::step(SimTime now) {
  while (has_next_ && next_.t_sim <= now) {
    ports_.publish(out_of_.at(next_.channel->id), msg::encode_value(msg::decode_inline(next_.payload)));
    has_next_ = read_next();
  }
  if (has_next_) return next_.t_sim;
  if (!reader_.truncated().empty()) ports_.health("degraded", "the record ends early " + reader_.truncated());
  if (config_.finish) ports_.finish();
  return kNever;
}

}  // namespace ensonify
