#include "tools/console/values.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ensonify::console {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLongSilence = 4.0;  // times the usual
constexpr double kLeastSilence_s = 1.0;
constexpr double kSmoothing = 0.1;

/// The topic of "nav/estimate.roll_rad", among those there are.
std::string topic_in(const std::string& name, const std::map<std::string, std::string>& types) {
  for (std::size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1))
    if (types.contains(name.substr(0, dot))) return name.substr(0, dot);
  return "";
}

std::string unit_of(const std::string& type, const std::string& field) {
  for (const msg::ConsoleScalar& scalar : scalars_of(type))
    if (scalar.field == field) return scalar.unit;
  return "";
}

}  // namespace

void Values::want(const std::set<std::string>& names, const std::map<std::string, std::string>& types) {
  for (auto& [name, series] : series_) series.wanted = names.contains(name);
  for (const std::string& name : names) {
    if (series_.contains(name)) continue;
    const std::string topic = topic_in(name, types);
    if (topic.empty()) continue;
    if (series_.size() >= kMostSeries) {
      const auto idle = std::find_if(series_.begin(), series_.end(), [](const auto& s) { return !s.second.wanted; });
      if (idle == series_.end()) return;
      series_.erase(idle);
      ++generation_;  // its numbers may come back, and then begin anew
    }
    Series fresh;
    fresh.topic = topic;
    fresh.field = name.substr(topic.size() + 1);
    fresh.unit = unit_of(types.at(topic), fresh.field);
    series_[name] = std::move(fresh);
  }
}

std::set<std::string> Values::topics() const {
  std::set<std::string> topics;
  for (const auto& [name, series] : series_)
    if (series.wanted) topics.insert(series.topic);
  return topics;
}

void Values::clear() {
  ++generation_;
  for (auto& [name, series] : series_) {
    Series empty;
    empty.topic = series.topic;
    empty.field = series.field;
    empty.unit = series.unit;
    empty.wanted = series.wanted;
    series = std::move(empty);
  }
}

void Values::take(const std::string& type, const msg::Packet& packet) {
  const auto wanted = [&](const auto& entry) { return entry.second.wanted && entry.second.topic == packet.topic; };
  if (std::none_of(series_.begin(), series_.end(), wanted)) return;
  if (epoch_ && *epoch_ != packet.envelope.epoch) clear();
  epoch_ = packet.envelope.epoch;
  const msg::Value message = msg::decode_value(packet.body, packet.body.size());
  double time_s = 1e-9 * static_cast<double>(packet.envelope.t_sim_ns);
  if (const msg::Value* stamp = message.find("stamp_ns"))
    if (const auto* stamp_ns = stamp->as<std::int64_t>()) time_s = 1e-9 * static_cast<double>(*stamp_ns);
  for (auto& [name, series] : series_)
    if (series.wanted && series.topic == packet.topic)
      add(series, packet.envelope.seq, {time_s, scalar_in(message, type, series.field, series.last_ping)});
}

/// Two points of a slot are kept as they are; of more, the least and the greatest.
void Values::close_slot(Series& series) {
  auto& found = series.in_slot;
  if (found.size() > 2) {
    const auto [low, high] = std::minmax_element(found.begin(), found.end(),
                                                 [](const Point& a, const Point& b) { return a.value < b.value; });
    std::vector<Point> kept{*low, *high};
    if (kept[0].time_s > kept[1].time_s) std::swap(kept[0], kept[1]);
    found = kept;
  }
  series.points.insert(series.points.end(), found.begin(), found.end());
  found.clear();
  while (!series.points.empty() && series.points.back().time_s - series.points.front().time_s > kKept_s) {
    series.points.pop_front();
    ++series.first;
  }
}

void Values::add(Series& series, std::uint64_t seq, Point point) {
  if (series.newest_s && point.time_s <= *series.newest_s) return;  // several of a time: the first
  const auto slot = static_cast<std::int64_t>(std::floor(point.time_s / kSlot_s + 1e-9));
  if (slot != series.slot) close_slot(series);
  series.slot = slot;
  if (series.newest_s) {
    const double passed_s = point.time_s - *series.newest_s;
    const bool silent = series.usual_s > 0.0 && passed_s > std::max(kLeastSilence_s, kLongSilence * series.usual_s);
    const bool lost = series.seq && seq > *series.seq + 1;
    if (silent || lost) {
      close_slot(series);
      series.points.push_back({*series.newest_s + 0.5 * passed_s, kNaN});
    } else {
      series.usual_s = series.usual_s > 0.0 ? (1.0 - kSmoothing) * series.usual_s + kSmoothing * passed_s : passed_s;
    }
  }
  series.newest_s = point.time_s;
  series.seq = seq;
  if (std::isfinite(point.value)) {
    series.in_slot.push_back(point);
  } else {
    close_slot(series);
    series.points.push_back({point.time_s, kNaN});
  }
  // What comes slowly need not wait for the end of its slot.
  if (series.usual_s > 0.5 * kSlot_s - 1e-6) close_slot(series);
}

std::optional<msg::ConsoleValues> Values::news(const std::vector<std::string>& names, Seen& seen) const {
  if (seen.generation != generation_) seen = {generation_, {}};
  msg::ConsoleValues news;
  news.generation = generation_;
  std::size_t left = kMostPoints;
  for (const std::string& name : names) {
    const auto found = series_.find(name);
    if (found == series_.end()) continue;
    const Series& series = found->second;
    std::int64_t& known = seen.points[name];
    known = std::max(known, series.first);
    const auto begin = static_cast<std::size_t>(known - series.first);
    const std::size_t count = std::min(series.points.size() - std::min(begin, series.points.size()), left);
    if (count == 0) continue;
    msg::ConsoleSeries fresh{name, series.unit, known, msg::Array<double>({count}), msg::Array<double>({count})};
    for (std::size_t i = 0; i < count; ++i) {
      fresh.time_s[i] = series.points[begin + i].time_s;
      fresh.value[i] = series.points[begin + i].value;
    }
    known += static_cast<std::int64_t>(count);
    left -= count;
    news.series.push_back(std::move(fresh));
  }
  if (news.series.empty()) return std::nullopt;
  return news;
}

}  // namespace ensonify::console
