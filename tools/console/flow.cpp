#include "tools/console/flow.h"

#include <algorithm>

namespace ensonify::console {

namespace {

double seconds(std::chrono::nanoseconds time) { return 1e-9 * static_cast<double>(time.count()); }

}  // namespace

Flow::Flow(WallTime now) : answered_(now), reported_(now) {}

void Flow::watch(const msg::ConsoleWatch& wish, WallTime now) {
  if (wish.topics.size() > kMostTopics)
    throw msg::DecodeError("topics: " + std::to_string(wish.topics.size()) +
                           " are too many; allowed: " + std::to_string(kMostTopics));
  if (wish.values.size() > kMostValues)
    throw msg::DecodeError("values: " + std::to_string(wish.values.size()) +
                           " are too many; allowed: " + std::to_string(kMostValues));
  for (const msg::ConsoleWatched& watched : wish.topics) {
    const auto most = static_cast<std::int64_t>(kMostCells);
    if (watched.cells < static_cast<std::int64_t>(kLeastCells) || watched.cells > most)
      throw msg::DecodeError(watched.topic + ": cells " + std::to_string(watched.cells) + "; allowed: 16 to 1024");
    if (!(watched.spreading_db >= 0.0 && watched.spreading_db <= 60.0 && watched.absorption_dbpm >= 0.0 &&
          watched.absorption_dbpm <= 1.0))
      throw msg::DecodeError(watched.topic + ": a gain has 0 to 60 dB of spreading and 0 to 1 dB/m of absorption");
  }
  wish_ = wish;
  std::erase_if(topics_,
                [&](const auto& entry) { return !watches(entry.first) && !entry.first.starts_with("console/"); });
  for (const msg::ConsoleWatched& watched : wish_.topics) {
    Topic& topic = topics_[watched.topic];
    topic.wish = {static_cast<std::size_t>(watched.cells), watched.peak, watched.spreading_db, watched.absorption_dbpm,
                  wishes_ground(watched.topic)};
  }
  answered_ = now;
}

bool Flow::watches(const std::string& topic) const {
  return std::any_of(wish_.topics.begin(), wish_.topics.end(),
                     [&](const auto& watched) { return watched.topic == topic; });
}

bool Flow::wishes_ground(const std::string& topic) const {
  return std::find(wish_.ground.begin(), wish_.ground.end(), topic) != wish_.ground.end();
}

bool Flow::has_waiting(const std::string& topic) const {
  const auto found = topics_.find(topic);
  return found != topics_.end() && !found->second.waiting.empty();
}

void Flow::offer(const Offer& offer, bool always) {
  if (!always && !watches(offer.topic)) return;
  Topic& topic = topics_[offer.topic];
  topic.way = offer.way;
  const std::size_t most = offer.way == Way::line ? kMostLines : 1;
  while (topic.waiting.size() >= most) {
    topic.waiting.pop_front();
    if (offer.way != Way::state) ++topic.lost;
  }
  topic.waiting.push_back(offer);
}

/// The topics of a way take turns.
Flow::Topic* Flow::ready(Way way) {
  const auto can_send = [&](const Topic& topic) {
    if (topic.waiting.empty() || topic.way != way) return false;
    const std::size_t ahead = way == Way::line ? kLinesAhead : 1;
    return way == Way::state || topic.on_its_way.size() < ahead;
  };
  const auto after = topics_.upper_bound(last_topic_);
  for (auto it = after; it != topics_.end(); ++it)
    if (can_send(it->second)) return &it->second;
  for (auto it = topics_.begin(); it != after; ++it)
    if (can_send(it->second)) return &it->second;
  return nullptr;
}

std::optional<Sending> Flow::next(WallTime now, std::size_t in_link) {
  if (away(now)) {
    was_away_ = true;
    // Lines would only be old when the viewer is back: the gap is counted.
    for (auto& [name, topic] : topics_) {
      if (topic.way == Way::line) topic.lost += static_cast<std::int64_t>(topic.waiting.size());
      if (topic.way == Way::line) topic.waiting.clear();
    }
    return std::nullopt;
  }
  for (const Way way : {Way::state, Way::line, Way::picture}) {
    if (way != Way::state && in_link > kInLink) return std::nullopt;
    Topic* topic = ready(way);
    if (topic == nullptr) continue;
    Sending sending{topic->waiting.front(), topic->wish};
    topic->waiting.pop_front();
    sending.wish.cells = std::max(topic->wish.cells >> topic->halved, kLeastCells);
    ++topic->sent;
    last_topic_ = sending.offer.topic;
    next_in_link_.reset();
    if (way != Way::state) {
      topic->on_its_way.push_back({sending.offer.packet->envelope.seq, sending.offer.arrived});
      next_in_link_ = {last_topic_, now, 0};
    }
    return sending;
  }
  return std::nullopt;
}

void Flow::sent(std::size_t bytes) {
  if (!next_in_link_ || (in_link_ && in_link_->bytes >= bytes)) return;
  next_in_link_->bytes = bytes;
  in_link_ = next_in_link_;
}

void Flow::passed(WallTime now, bool empty) {
  if (!in_link_) return;
  const auto took = now - in_link_->began;
  if (!empty && took <= kSlow) return;
  if (empty && in_link_->bytes > kInLink && took.count() > 0)
    link_bytes_per_s_ = static_cast<double>(in_link_->bytes) / seconds(took);
  judge(took);
  in_link_.reset();
}

/// The link has needed so long for the message that is timed, or longer.
void Flow::judge(std::chrono::nanoseconds took) {
  const auto found = topics_.find(in_link_->topic);
  if (found == topics_.end()) return;
  Topic& topic = found->second;
  if (took > kSlow) {
    topic.fast = 0;
    if (topic.halved < kMostHalvings && (topic.wish.cells >> topic.halved) > kLeastCells) ++topic.halved;
  } else if (took < kFast) {
    if (++topic.fast < kFastEnough || topic.halved == 0) return;
    topic.fast = 0;
    --topic.halved;
  }
}

void Flow::drawn(const std::string& name, std::uint64_t seq, WallTime now) {
  const auto found = topics_.find(name);
  if (found == topics_.end()) return;
  Topic& topic = found->second;
  const auto it =
      std::find_if(topic.on_its_way.begin(), topic.on_its_way.end(), [&](const OnItsWay& o) { return o.seq == seq; });
  if (it == topic.on_its_way.end()) return;
  topic.age_s = seconds(now - it->arrived);
  // What was sent before it has been drawn as well, or never will be.
  topic.on_its_way.erase(topic.on_its_way.begin(), it + 1);
}

bool Flow::answered(WallTime now) {
  answered_ = now;
  if (wish_.hidden || !was_away_) return false;
  was_away_ = false;
  for (auto& [name, topic] : topics_) topic.on_its_way.clear();
  return true;
}

bool Flow::away(WallTime now) const { return wish_.hidden || now - answered_ > kPatience; }

msg::ConsoleFlow Flow::report(WallTime now) {
  msg::ConsoleFlow flow;
  flow.link_bytes_per_s = link_bytes_per_s_;
  const double passed_s = std::max(seconds(now - reported_), 1e-3);
  reported_ = now;
  for (auto& [name, topic] : topics_) {
    for (const Offer& offer : topic.waiting) flow.waiting_bytes += static_cast<std::int64_t>(offer.packet->body.size());
    if (name.starts_with("console/")) continue;
    flow.topics.push_back({name, topic.sent, topic.lost, topic.halved,
                           static_cast<double>(topic.sent - topic.reported) / passed_s, topic.age_s});
    topic.reported = topic.sent;
  }
  return flow;
}

}  // namespace ensonify::console
