#include "components/nav_out/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "components/errors/exit_error.h"
#include "components/formats/nmea/writer.h"
#include "components/runtime/log.h"
#include "components/runtime/rate_limit.h"
#include "messages/terrain.h"

namespace ensonify {
namespace {

using nav_out::Kind;
using nav_out::Source;

constexpr std::size_t kMostVessels = 64;
constexpr std::size_t kPieceBytes = 96;  // its map in feed_data, without the name

/// The most that `sent` holds of one event.
std::size_t most_bytes(const NavOutConfig& config) {
  double sum = 1024.0;
  for (const Output& output : config.outputs) {
    for (const auto& [kind, hz] : output.lines()) {
      const double at_once = std::ceil(hz / config.step_rate_hz) + 1.0;
      const double each = static_cast<double>(kind.most_bytes + kPieceBytes + output.name.size());
      sum += at_once * each * (kind.source == Source::kVessels ? kMostVessels : 1);
    }
  }
  return static_cast<std::size_t>(sum);
}

/// Events of the grid, those at which something leaves between them, and those of ZDA.
Rate event_rate(const NavOutConfig& config) {
  std::set<double> latencies;
  std::int64_t times = 0;
  for (const Output& output : config.outputs) {
    latencies.insert(output.latency_s);
    for (const auto& [kind, hz] : output.lines()) {
      if (kind.source == Source::kClock) times += static_cast<std::int64_t>(std::ceil(hz));
    }
  }
  return {config.step_rate_hz * (1 + static_cast<std::int64_t>(latencies.size())) + times, 1};
}

}  // namespace

NavOutNode::NavOutNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      due_(Rate{config.step_rate_hz, 1}),
      instruments_(config.start_unix_ns, static_cast<std::uint32_t>(config.ais.mmsi)),
      sent_(ports.out<msg::FeedData>("sent", {.max_bytes = most_bytes(config), .rate = event_rate(config)})) {
  for (std::size_t i = 0; i < config.outputs.size(); ++i) {
    for (const auto& [kind, hz] : config.outputs[i].lines()) {
      Line line{i, kind, hz, {}, {}};
      const std::int64_t second_ns = (1'000'000'000 - config.start_unix_ns % 1'000'000'000) % 1'000'000'000;
      if (kind.source == Source::kClock) line.due.emplace(rate_of(hz), SimTime{second_ns});
      lines_.push_back(line);
    }
  }
  if (config.origin) instruments_.set_origin(*config.origin);
  connect();
}

double NavOutNode::highest_hz(Source source) const {
  double hz = 0.0;
  for (const Line& line : lines_) {
    if (line.kind.source == source) hz = std::max(hz, line.hz);
  }
  return hz;
}

/// Only what the sentences need; the estimate always, for grid north is told from true north where it is.
void NavOutNode::connect() {
  const auto least = [&](double hz) { return InOptions{.least = rate_of(hz)}; };
  ports_.in<msg::Estimate>(
      "estimate", [this](const msg::Estimate& m) { measured(Source::kEstimate, m); },
      least(highest_hz(Source::kEstimate)));
  ports_.in<msg::Position>(
      "position", [this](const msg::Position& m) { measured(Source::kPosition, m); },
      least(highest_hz(Source::kPosition)));
  const double heading_hz = highest_hz(Source::kHeading);
  const bool km_binary =
      std::any_of(lines_.begin(), lines_.end(), [](const Line& line) { return line.kind.kind == Kind::kKmBinary; });
  if (says(Source::kAttitude) || says(Source::kHeading) || km_binary) {
    ports_.in<msg::Attitude>(
        "attitude",
        [this](const msg::Attitude& m) {
          measured(Source::kAttitude, m);
          if (!compass_) measured(Source::kHeading, m);
        },
        least(highest_hz(Source::kAttitude)));
  }
  if (heading_hz > 0.0) {
    ports_.in<msg::Heading>("heading", [this](const msg::Heading& m) { measured(Source::kHeading, m); },
                            {.optional = true, .least = rate_of(heading_hz)});
  }
  if (says(Source::kAltitude)) {
    ports_.in<msg::Altitude>(
        "altitude", [this](const msg::Altitude& m) { measured(Source::kAltitude, m); },
        least(highest_hz(Source::kAltitude)));
  }
  if (says(Source::kVessels)) {
    ports_.in_topics<msg::Estimate>("vessels", {"*"},
                                    [this](const std::string& of, const msg::Estimate& m) {
                                      if (vessels_) vessels_->take(of, nav_out::motion_of(m), instruments_.earth());
                                    },
                                    {.optional = true});
    std::vector<std::string> topics;
    for (const std::string& name : config_.ais.poses) topics.push_back(name + "/pose");
    if (!topics.empty()) {
      ports_.in_topics<msg::Pose>("poses", topics, [this](const std::string& of, const msg::Pose& m) {
        if (vessels_) vessels_->take(of, nav_out::motion_of(m), instruments_.earth());
      });
    }
  }
  if (!config_.origin) {
    ports_.in<msg::Chart>("chart", [this](const msg::Chart& chart) {
      instruments_.set_origin({chart.origin_latitude_deg, chart.origin_longitude_deg});
    });
  }
}

/// What is known once all is wired: who has a compass, the rates of instruments, and who else is at sea.
void NavOutNode::begin() {
  std::map<std::string, double> hz;
  std::string own;
  std::set<std::string> others;
  for (const Feed& feed : ports_.feeds()) {
    const std::string& port = ports_.ins()[feed.in_index].port;
    if (port == "vessels" || port == "poses") others.insert(feed.publisher);
    else hz[port] = stated_rate(feed.rate).hz();
    if (port == "estimate") own = feed.publisher;
  }
  others.erase(own);
  compass_ = hz.contains("heading");
  if (compass_) instruments_.carry_compass();
  if (says(Source::kVessels)) {
    vessels_.emplace(std::vector<std::string>(others.begin(), others.end()),
                     static_cast<std::uint32_t>(config_.ais.mmsi) + 1);
  }
  const auto port_of = [&](Source source) {
    switch (source) {
      case Source::kPosition: return "position";
      case Source::kAttitude: return "attitude";
      case Source::kHeading: return compass_ ? "heading" : "attitude";
      case Source::kAltitude: return "altitude";
      default: return "estimate";
    }
  };
  for (Line& line : lines_) {
    if (line.due) continue;
    line.pace.emplace(line.hz, std::max(line.hz, hz[port_of(line.kind.source)]), config_.start_unix_ns);
  }
  try {
    sinks_.emplace(config_.outputs, ports_.out_dir());
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}", ports_.process(), error.what()));
  }
}

/// A measurement is there: the sentences that are due with it are said.
template <class Message>
void NavOutNode::measured(Source source, const Message& message) {
  if (!sinks_) begin();
  instruments_.take(message);
  for (Line& line : lines_) {
    if (line.kind.source != source || !line.pace->take(message.stamp_ns)) continue;
    std::string bytes = instruments_.say(line.kind.kind, config_.outputs[line.output]);
    if (!bytes.empty()) fresh_.push_back({SimTime{0}, line.output, std::move(bytes)});
  }
}

void NavOutNode::report_vessels() {
  for (const Line& line : lines_) {
    if (line.kind.source != Source::kVessels) continue;
    const std::string& name = config_.outputs[line.output].name;
    for (std::string& report : vessels_->reports(name, line.hz, instruments_.earth()))
      fresh_.push_back({SimTime{0}, line.output, std::move(report)});
  }
}

/// ZDA leaves at the moment that it says.
void NavOutNode::say_time(SimTime now) {
  for (Line& line : lines_) {
    if (!line.due || !line.due->due(now)) continue;
    const std::string& talker = config_.outputs[line.output].talker;
    std::string bytes = nmea::zda(talker.empty() ? "GP" : talker, instruments_.earth().date_and_time(now.count()));
    waiting_.emplace(now, Waiting{now, line.output, std::move(bytes)});
  }
}

SimTime NavOutNode::step(SimTime now) {
  if (!sinks_) begin();
  say_time(now);
  if (due_.due(now) && vessels_) report_vessels();
  for (Waiting& one : std::exchange(fresh_, {})) {
    one.leaves = now + from_seconds(config_.outputs[one.output].latency_s);
    waiting_.emplace(one.leaves, std::move(one));
  }
  send_due(now);
  count_sent();
  SimTime next = waiting_.empty() ? due_.next() : std::min(due_.next(), waiting_.begin()->first);
  for (const Line& line : lines_) {
    if (line.due) next = std::min(next, line.due->next());
  }
  return next;
}

void NavOutNode::send_due(SimTime now) {
  msg::FeedData sent;
  sent.stamp_ns = now.count();
  std::vector<std::uint8_t> bytes;
  for (; !waiting_.empty() && waiting_.begin()->first <= now; waiting_.erase(waiting_.begin())) {
    const Waiting& one = waiting_.begin()->second;
    sinks_->put(one.output, one.bytes);
    sent.pieces.push_back(
        {config_.outputs[one.output].name, now.count(), static_cast<std::int64_t>(one.bytes.size()), false, true});
    bytes.insert(bytes.end(), one.bytes.begin(), one.bytes.end());
  }
  if (sent.pieces.empty()) return;
  sent.bytes = msg::Array<std::uint8_t>::of(std::move(bytes));
  sent_.send(sent);
}

/// Of all outputs together. Only where something is lost, refused or late do counts follow from wall time.
void NavOutNode::count_sent() {
  std::map<std::string, std::int64_t> now;
  for (const nav_out::Sinks::Counts& one : sinks_->counts()) {
    now["sentences"] += one.pieces;
    now["bytes"] += one.bytes;
    now["lost"] += one.sent.lost;
    now["refused"] += one.sent.refused;
    now["late"] += one.sent.late;
  }
  for (const auto& [what, count] : now) {
    if (count > counts_[what]) ports_.count(what, count - counts_[what]);
  }
  counts_ = std::move(now);
}

void NavOutNode::finish_run() {
  if (!sinks_) return;
  sinks_->finish();
  for (const nav_out::Sinks::Counts& one : sinks_->counts()) {
    log::event(ports_, "sent", "to={} sentences={} bytes={} lost={} refused={} late={} latest_s={:.3f}", one.name,
               one.pieces, one.bytes, one.sent.lost, one.sent.refused, one.sent.late, one.sent.latest_s);
  }
}

}  // namespace ensonify
