#include "components/recorder/node.h"

#include "components/errors/exit_error.h"
#include "messages/schema.h"

namespace ensonify {

namespace {

constexpr Rate kEventRate{10, 1};

std::vector<std::string> patterns(const RecorderConfig& config) {
  std::vector<std::string> patterns;
  for (const RecordedTopics& topics : config.topics) patterns.push_back(topics.pattern);
  return patterns;
}

}  // namespace

RecorderNode::RecorderNode(const Config& config, Ports& ports) : config_(config), ports_(ports), due_(kEventRate) {
  ports.in_any("topics", patterns(config), [this](const msg::Packet& packet) { keep(packet); });
}

record::RecordWriter& RecorderNode::open() {
  if (writer_) return *writer_;
  const auto& facts = ports_.facts();
  const auto version = facts.find("version");
  try {
    writer_.emplace(
        ports_.out_dir() / config_.file,
        record::RecordInfo{version == facts.end() ? "" : version->second, config_.seed, config_.start_unix_ns},
        record::attachments_of(facts));
  } catch (const UserError& error) {
    throw UserError((config_.file_place.empty() ? "" : config_.file_place + ": file: ") + error.what());
  }
  for (const Feed& feed : ports_.feeds()) {
    writer_->add_channel({static_cast<std::uint16_t>(feed.topic_id), feed.topic, feed.type,
                          msg::json_schema(msg::find_type(feed.type)), feed.rank, feed.max_bytes});
    every_[feed.topic_id] = static_cast<std::uint64_t>(config_.every(feed.topic));
  }
  return *writer_;
}

void RecorderNode::keep(const msg::Packet& packet) {
  record::RecordWriter& writer = open();
  const msg::Envelope& envelope = packet.envelope;
  if (envelope.seq % every_.at(envelope.topic_id) != 0) return;
  writer.write(static_cast<std::uint16_t>(envelope.topic_id), envelope.seq, SimTime{envelope.t_sim_ns},
               msg::encode_inline(packet.body));
}

SimTime RecorderNode::step(SimTime now) {
  open();
  due_.due(now);
  return due_.next();
}

void RecorderNode::finish_run() {
  if (writer_) writer_->close();
}

}  // namespace ensonify
