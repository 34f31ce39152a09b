#include "tools/console/desk.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "components/view/ping_view.h"
#include "messages/clock.h"
#include "messages/health.h"
#include "messages/mission.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "messages/sonar.h"
#include "messages/soundings.h"
#include "messages/terrain.h"
#include "tools/console/relief.h"
#include "tools/console/upright.h"

namespace ensonify::console {

namespace {

constexpr std::chrono::milliseconds kPollBudget{4};
constexpr std::chrono::milliseconds kAlarmsEvery{250};
constexpr std::chrono::milliseconds kLogsEvery{250};
constexpr std::chrono::seconds kChartEvery{5};
constexpr int kChartTries = 12;  // a recorder writes the first messages after some seconds
constexpr std::chrono::seconds kDiskEvery{5};
constexpr std::size_t kKept = 8;      // pictures that several viewers may share
constexpr std::size_t kFinds = 16;    // pings of a head whose detections may belong to a picture that is still to come
constexpr std::size_t kFanBeams = 3;  // a head with fewer beams draws lines
constexpr std::string_view kPing = "ping";
constexpr std::string_view kView = "view";
constexpr std::string_view kBottomTrack = "bottom_track";

bool is_state(const std::string& type) {
  return type == msg::Health::kType || type == msg::ClockHealth::kType || type == msg::MissionState::kType;
}

bool is_track(const std::string& type) { return type == msg::Estimate::kType || type == msg::Pose::kType; }

/// Number of beams of a ping, 0 where it says none.
std::size_t beams_of(const msg::Packet& packet) {
  const msg::Value ping = msg::decode_value(packet.body, packet.body.size());
  const msg::Value* angles = ping.find("beam_angle_rad");
  const auto* array = angles == nullptr ? nullptr : angles->as<msg::RawArray>();
  return array == nullptr ? 0 : array->size();
}

std::string process_of(const std::string& topic) { return topic.substr(0, topic.find('/')); }

/// From which latitude and longitude follow.
bool places_world(const std::string& type) { return type == msg::Chart::kType || type == msg::Position::kType; }

/// Where the processes of a run write their logs.
std::string log_folder(const Source& source) { return source.folder().empty() ? "" : source.folder() + "/log"; }

/// "side/view_main" of "side/bottom_track_main".
std::string view_topic_beside(const std::string& bottom_topic) {
  std::string topic = bottom_topic;
  const std::size_t at = topic.find(kBottomTrack);
  return at == std::string::npos ? "" : topic.replace(at, kBottomTrack.size(), kView);
}

/// A message that a desk has made.
template <msg::Message M>
msg::Packet packet_of(const char* topic, const M& message, std::uint64_t seq) {
  msg::Packet packet{topic, {}, msg::encode(message), {}};
  packet.envelope.type_hash = msg::type_hash(M::kType);
  packet.envelope.seq = seq;
  return packet;
}

std::string upright_topic_of(const std::string& view_topic) { return view_topic + std::string(kUpright); }

bool plans(const std::string& type) { return type == msg::NextLine::kType || type == msg::Mark::kType; }

}  // namespace

std::string view_topic_of(const std::string& ping_topic) {
  const std::size_t slash = ping_topic.find('/');
  if (slash == std::string::npos || ping_topic.compare(slash + 1, kPing.size(), kPing) != 0)
    return ping_topic + "/view";
  return ping_topic.substr(0, slash + 1) + std::string(kView) + ping_topic.substr(slash + 1 + kPing.size());
}

Desk::Desk(std::unique_ptr<Source> source, const AlarmLimits& alarms) : source_(std::move(source)), alarms_(alarms) {
  refresh();
}

void Desk::add(Flow& flow) { viewers_.push_back(&flow); }

void Desk::remove(Flow& flow) {
  viewers_.remove(&flow);
  left_ = std::chrono::steady_clock::now();
  // The source's sockets are let go with the desk, a few seconds after the last viewer.
  if (!viewers_.empty()) ask_source();
}

void Desk::settle(Flow& flow) {
  ask_source();
  for (const auto& [topic, offer] : newest_) flow.offer(offer);
}

void Desk::ask_source() {
  std::set<std::string> names;
  for (const Flow* flow : viewers_)
    if (flow->watches(kValuesTopic)) names.insert(flow->values().begin(), flow->values().end());
  values_.want(names, type_of_);
  std::set<std::string> wanted = values_.topics();
  for (const auto& entry : type_of_) {
    const std::string& topic = entry.first;
    const bool soundings = entry.second == msg::Soundings::kType;
    const std::string name = makes_view_of(topic, entry.second) ? view_topic_of(topic) : topic;
    const std::string made = soundings ? kCellsTopic : is_track(entry.second) ? kTrackTopic : "";
    const auto wants = [&](const Flow* flow) {
      return flow->watches(name) || flow->watches(upright_topic_of(name)) || (!made.empty() && flow->watches(made)) ||
             (soundings && wants_finds(*flow, process_of(topic))) ||
             (places_world(entry.second) && !(entry.second == msg::Chart::kType && has_relief_) &&
              (flow->watches(kReliefTopic) || flow->watches(kPlanTopic))) ||
             (entry.second == msg::BottomTrack::kType && flow->wishes_ground(view_topic_beside(topic))) ||
             (plans(entry.second) && flow->watches(kPlanTopic)) ||
             (Alarms::needs(entry.second) && flow->watches(kAlarmsTopic));
    };
    if (std::any_of(viewers_.begin(), viewers_.end(), wants)) wanted.insert(topic);
  }
  alarms_.keep(wanted);
  source_->want(wanted);
}

void Desk::refresh() {
  state_ = source_->state();
  if (state_.message.empty()) state_.message = fault_;
  type_of_.clear();
  for (const msg::ConsoleTopic& topic : state_.topics) type_of_[topic.name] = topic.type;
  std::erase_if(state_.topics, [this](const msg::ConsoleTopic& topic) {
    return topic.type == msg::Ping::kType && !makes_view_of(topic.name, topic.type);
  });
  for (msg::ConsoleTopic& topic : state_.topics) {
    if (topic.type != msg::Ping::kType) continue;
    topic.name = view_topic_of(topic.name);
    topic.type = msg::View::kType;
  }
  std::error_code error;
  bool cells = false, tracks = false, alarms = false, chart = false;
  for (const auto& [topic, type] : type_of_) {
    cells = cells || type == msg::Soundings::kType;
    tracks = tracks || is_track(type);
    alarms = alarms || Alarms::needs(type);
    chart = chart || places_world(type);
  }
  std::set<std::string> types;
  for (const auto& [topic, type] : type_of_) types.insert(type);
  for (const std::string& type : types)
    if (!scalars_of(type).empty()) state_.types.push_back({type, scalars_of(type)});
  if (!state_.types.empty()) state_.topics.push_back({kValuesTopic, msg::ConsoleValues::kType, "", ""});
  if (alarms) state_.topics.push_back({kAlarmsTopic, msg::ConsoleAlarms::kType, "", ""});
  if (std::filesystem::is_directory(std::filesystem::symlink_status(log_folder(*source_), error)))
    state_.topics.push_back({kLogTopic, msg::ConsoleLog::kType, "", ""});
  if (chart || tracks) state_.topics.push_back({kPlanTopic, msg::ConsolePlan::kType, "", ""});
  if (chart) state_.topics.push_back({kReliefTopic, msg::ConsoleRelief::kType, "", ""});
  if (cells) state_.topics.push_back({kCellsTopic, msg::ConsoleCells::kType, "", ""});
  if (tracks) state_.topics.push_back({kTrackTopic, msg::ConsoleTrack::kType, "", ""});
}

bool Desk::poll(WallTime now) {
  const bool was_relieved = has_relief_;
  try {
    source_->poll(now, kPollBudget, [&](msg::Packet packet) { take(std::move(packet), now); });
  } catch (const std::exception& e) {
    // A message that cannot be read, a file that has gone: what follows is taken at the next poll.
    fault_ = e.what();
  }
  msg::ConsoleState fresh = source_->state();
  if (fresh.message.empty()) fresh.message = fault_;
  const bool was_away = state_.state == "waiting" || state_.state == "ended";
  const bool another = fresh.kind == "run" && was_away && fresh.state == "running";  // of that name
  if (another) {
    survey_.clear();
    values_.clear();
    alarms_.clear();
    logs_.clear();
    has_map_ = has_relief_ = has_plan_ = false;
    plan_.clear();
    chart_tries_ = 0;
    newest_.clear();
    finds_.clear();
    altitude_m_.clear();
    fault_.clear();
  }
  if (has_relief_ && !was_relieved) ask_source();  // who has the chart needs it no more
  watch_disk(now);
  read_logs(now);
  find_chart(now);
  make_plan(now);
  offer_alarms(now);
  const bool topics_changed = fresh.topics.size() != type_of_.size();
  if (!topics_changed && fresh.state == state_.state && fresh.message == state_.message &&
      fresh.speed == state_.speed && fresh.name == state_.name)
    return false;
  refresh();
  if (topics_changed || another) ask_source();
  return true;
}

void Desk::watch_disk(WallTime now) {
  if (state_.kind != "run" || state_.state != "running" || now - disk_seen_ < kDiskEvery) return;
  disk_seen_ = now;
  std::error_code error;
  const auto space = std::filesystem::space(source_->folder(), error);
  if (!error) alarms_.disk(source_->folder(), space.available);
}

void Desk::read_logs(WallTime now) {
  const auto watches = [](const Flow* flow) { return flow->watches(kLogTopic); };
  if (now - logs_read_ < kLogsEvery || std::none_of(viewers_.begin(), viewers_.end(), watches)) return;
  logs_read_ = now;
  logs_.read(log_folder(*source_));
}

/// A chart is published once, before anybody watches: then it is in the record.
void Desk::find_chart(WallTime now) {
  const auto watches = [](const Flow* flow) { return flow->watches(kReliefTopic) || flow->watches(kPlanTopic); };
  if (has_relief_ || chart_tries_ >= kChartTries || now - chart_sought_ < kChartEvery ||
      std::none_of(viewers_.begin(), viewers_.end(), watches))
    return;
  chart_sought_ = now;
  ++chart_tries_;
  if (const auto chart = chart_in(state_.kind == "record" ? state_.name : source_->folder())) {
    take_chart(*chart, now);
  }
}

void Desk::take_chart(const msg::Chart& chart, WallTime now) {
  if (std::exchange(has_relief_, true)) return;
  offer_relief(relief_of(chart), now);
  plan_.take(chart);
  plan_is_new_ = true;
}

void Desk::give(const Offer& offer) {
  if (offer.way != Way::line) newest_[offer.topic] = offer;
  for (Flow* flow : viewers_) flow->offer(offer);
}

void Desk::offer_newest(const char* topic, Way way, msg::Packet packet, WallTime now) {
  give({topic, way, std::make_shared<const msg::Packet>(std::move(packet)), now});
}

void Desk::offer_relief(const msg::ConsoleRelief& relief, WallTime now) {
  has_map_ = true;
  offer_newest(kReliefTopic, Way::picture, packet_of(kReliefTopic, relief, relief_seq_++), now);
}

/// The scenario is read when somebody wants the plan, and not before.
void Desk::make_plan(WallTime now) {
  const auto watches = [](const Flow* flow) { return flow->watches(kPlanTopic); };
  if (std::none_of(viewers_.begin(), viewers_.end(), watches)) return;
  if (const std::string scenario = has_plan_ ? "" : source_->scenario(); !scenario.empty()) {
    plan_.read(scenario);
    has_plan_ = plan_is_new_ = true;
  }
  if (!std::exchange(plan_is_new_, false)) return;
  offer_newest(kPlanTopic, Way::picture, packet_of(kPlanTopic, plan_.message(), plan_seq_++), now);
}

void Desk::offer_alarms(WallTime now) {
  if (now - alarms_said_ < kAlarmsEvery || !alarms_.changed()) return;
  alarms_said_ = now;
  offer_newest(kAlarmsTopic, Way::state, packet_of(kAlarmsTopic, alarms_.message(), alarms_seq_++), now);
}

bool Desk::makes_view_of(const std::string& topic, const std::string& type) const {
  return type == msg::Ping::kType && !type_of_.contains(view_topic_of(topic));
}

/// Detections are added to pictures that are made here; a head's own have them.
bool Desk::wants_finds(const Flow& flow, const std::string& head) const {
  const std::string begin = head + "/" + std::string(kView);
  return std::any_of(flow.watched().begin(), flow.watched().end(), [&](const msg::ConsoleWatched& watched) {
    const std::string view = watched.topic.substr(0, watched.topic.find(kUpright));
    return view.starts_with(begin) && !type_of_.contains(view);
  });
}

void Desk::take(msg::Packet packet, WallTime now) {
  const auto type = type_of_.find(packet.topic);
  if (type == type_of_.end()) return;
  Offer offer{packet.topic, Way::line, nullptr, now};
  if (makes_view_of(packet.topic, type->second) || type->second == msg::View::kType) {
    if (type->second == msg::Ping::kType) offer.topic = view_topic_of(packet.topic);
    try {
      if (beams_of(packet) >= kFanBeams) offer.way = Way::picture;
    } catch (const msg::DecodeError&) {
      return;  // a foreign program's message that is no ping: message_of would say the same
    }
  } else if (is_state(type->second)) {
    offer.way = Way::state;
  }
  try {
    values_.take(type->second, packet);
    alarms_.take(type->second, packet);
    if (type->second == msg::Chart::kType) {
      take_chart(msg::decode<msg::Chart>(packet.body, packet.body.size()), now);
    } else if (type->second == msg::Position::kType && !has_map_) {
      if (const auto map = map_of(msg::decode<msg::Position>(packet.body, packet.body.size()))) offer_relief(*map, now);
    }
    survey_.take(type->second, packet);
    if (type->second == msg::NextLine::kType) plan_.take(msg::decode<msg::NextLine>(packet.body, packet.body.size()));
    if (type->second == msg::Mark::kType) plan_.take(msg::decode<msg::Mark>(packet.body, packet.body.size()));
    plan_is_new_ = plan_is_new_ || plans(type->second);
    if (type->second == msg::BottomTrack::kType) {
      const auto bottom = msg::decode<msg::BottomTrack>(packet.body, packet.body.size());
      if (bottom.valid && bottom.altitude_m > 0.0) altitude_m_[view_topic_beside(packet.topic)] = bottom.altitude_m;
    }
    if (type->second == msg::Soundings::kType) {
      auto& finds = finds_[process_of(packet.topic)];
      finds.push_back(msg::decode<msg::Soundings>(packet.body, packet.body.size()));
      if (finds.size() > kFinds) finds.pop_front();
    }
  } catch (const msg::DecodeError&) {
    return;  // as above
  }
  offer.packet = std::make_shared<const msg::Packet>(std::move(packet));
  give(offer);
  if (offer.way != Way::picture) return;
  offer.topic = upright_topic_of(offer.topic);
  give(offer);
}

msg::View Desk::picture_of(const Sending& sending, const std::string& type) const {
  if (sending.offer.topic.ends_with(kUpright)) return upright(slant_picture_of(sending, type));
  const auto altitude = altitude_m_.find(sending.offer.topic);
  const bool ground = sending.wish.ground && altitude != altitude_m_.end();
  return ground ? on_ground(slant_picture_of(sending, type), altitude->second) : slant_picture_of(sending, type);
}

msg::View Desk::slant_picture_of(const Sending& sending, const std::string& type) const {
  const msg::Packet& packet = *sending.offer.packet;
  if (type == msg::View::kType) return view_as(msg::decode<msg::View>(packet.body, packet.body.size()), sending.wish);
  const auto ping = msg::decode<msg::Ping>(packet.body, packet.body.size());
  const std::string head = process_of(packet.topic);
  msg::View view = view_of(ping, source_->beam_axis(head), sending.wish);
  if (const auto finds = finds_.find(head); finds != finds_.end()) {
    for (const msg::Soundings& soundings : finds->second)
      if (soundings.ping == ping.ping && soundings.stamp_ns == ping.stamp_ns) add_finds(view, soundings);
  }
  return view;
}

msg::Packet Desk::message_of(const Sending& sending) {
  const msg::Packet& packet = *sending.offer.packet;
  const auto type = type_of_.find(packet.topic);
  if (type == type_of_.end() || (type->second != msg::Ping::kType && type->second != msg::View::kType)) return packet;
  const auto known = std::find_if(made_.begin(), made_.end(), [&](const Made& made) {
    return made.of == sending.offer.packet && made.topic == sending.offer.topic && made.wish == sending.wish;
  });
  if (known != made_.end()) return known->packet;

  const msg::View view = picture_of(sending, type->second);
  msg::Packet picture{sending.offer.topic, packet.envelope, msg::encode(view), {}};
  picture.envelope.type_hash = msg::type_hash(msg::View::kType);
  made_.push_front({sending.offer.packet, sending.offer.topic, sending.wish, picture});
  if (made_.size() > kKept) made_.pop_back();
  return picture;
}

}  // namespace ensonify::console
