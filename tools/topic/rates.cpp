// How often and how much messages come: `hz` and `bw`.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "tools/topic/meter.h"
#include "tools/topic/observe.h"
#include "tools/topic/pretty.h"
#include "tools/topic/select.h"

namespace ensonify::topic_tool {
namespace {

using std::chrono::steady_clock;

enum class What { kRate, kBandwidth };
using Meters = std::map<std::string, Meter>;

void print_head(What what, std::size_t width) {
  if (what == What::kRate) {
    fmt::print("{:<{}} {:>9} {:>9} {:>14} {:>12} {:>15} {:>9} {:>8}\n", "topic", width, "sim Hz", "wall Hz",
               "interval (ms)", "jitter (ms)", "sim jitter (ms)", "received", "dropped");
  } else {
    fmt::print("{:<{}} {:>12} {:>14} {:>10} {:>10} {:>10} {:>9} {:>8}\n", "topic", width, "per wall s", "per sim s",
               "mean", "smallest", "largest", "received", "dropped");
  }
}

void print_row(What what, const std::string& topic, std::size_t width, const Traffic& t) {
  if (what == What::kRate) {
    fmt::print("{:<{}} {:>9.3f} {:>9.3f} {:>14.3f} {:>12.3f} {:>15.3f} {:>9} {:>8}\n", topic, width, t.sim_hz,
               t.wall_hz, 1e3 * t.wall.mean_s, 1e3 * t.wall.jitter_s, 1e3 * t.sim.jitter_s, t.received, t.dropped);
  } else {
    fmt::print("{:<{}} {:>12} {:>14} {:>10} {:>10} {:>10} {:>9} {:>8}\n", topic, width, bytes_text(t.wall_bytes_per_s),
               bytes_text(t.sim_bytes_per_s), bytes_text(t.mean_bytes), bytes_text(static_cast<double>(t.min_bytes)),
               bytes_text(static_cast<double>(t.max_bytes)), t.received, t.dropped);
  }
}

nlohmann::ordered_json to_json(const std::string& topic, const Traffic& t) {
  return {{"topic", topic},
          {"received", t.received},
          {"dropped", t.dropped},
          {"sim_hz", t.sim_hz},
          {"wall_hz", t.wall_hz},
          {"wall_interval_s", t.wall.mean_s},
          {"wall_jitter_s", t.wall.jitter_s},
          {"sim_interval_s", t.sim.mean_s},
          {"sim_jitter_s", t.sim.jitter_s},
          {"wall_bytes_per_s", t.wall_bytes_per_s},
          {"sim_bytes_per_s", t.sim_bytes_per_s},
          {"mean_bytes", t.mean_bytes},
          {"min_bytes", t.min_bytes},
          {"max_bytes", t.max_bytes}};
}

class Reporter {
 public:
  Reporter(What what, bool json, const Meters& meters) : what_(what), json_(json), meters_(meters) {
    for (const auto& [topic, meter] : meters) width_ = std::max(width_, topic.size());
  }

  /// Rows of the topics that have come so far.
  void report() {
    if (json_) return;
    for (const auto& [topic, meter] : meters_) {
      const Traffic t = meter.traffic();
      if (t.received == 0) continue;
      if (!headed_) print_head(what_, width_);
      headed_ = true;
      print_row(what_, topic, width_, t);
    }
    if (std::fflush(stdout) != 0) throw DataLost("standard output cannot be written");
  }

  /// 0 if a rate can be reported of at least one topic.
  int finish() {
    report();
    std::string silent;
    std::size_t measured = 0;
    auto all = nlohmann::ordered_json::array();
    for (const auto& [topic, meter] : meters_) {
      const Traffic t = meter.traffic();
      all.push_back(to_json(topic, t));
      if (t.received >= 2) ++measured;
      else silent += " " + topic;
    }
    if (json_) fmt::print("{}\n", all.dump());
    if (!silent.empty()) fmt::print(stderr, "ensonify topic: fewer than two messages came on{}\n", silent);
    return measured > 0 ? kExitOk : kExitAssertionFailed;
  }

 private:
  What what_;
  bool json_;
  const Meters& meters_;
  std::size_t width_ = 5;
  bool headed_ = false;
};

int measure(What what, const Options& options) {
  constexpr std::chrono::seconds kReportEvery{1};
  ClockClient clock(options.run);
  const auto selected = select(clock.registry(), options.topics);
  Meters meters;
  for (const TopicEntry& topic : selected) meters.emplace(topic.name, Meter(options.window));
  Reporter reporter(what, options.json, meters);
  bus::Observer observer = observe(clock, selected);
  const auto until = deadline(options);
  auto report_at = steady_clock::now() + kReportEvery;
  std::uint64_t received = 0;
  while (options.count == 0 || received < options.count) {
    const auto packet = observer.next(until ? std::min(*until, report_at) : report_at);
    const auto now = steady_clock::now();
    if (packet) {
      const auto meter = meters.find(packet->topic);
      if (meter == meters.end()) continue;
      meter->second.add(now, SimTime{packet->envelope.t_sim_ns}, packet->envelope.seq, packet->body.size());
      ++received;
    } else if (interrupted() || observer.ended() || (until && now >= *until)) {
      break;
    }
    if (now >= report_at) {
      reporter.report();
      report_at = now + kReportEvery;
    }
  }
  return reporter.finish();
}

}  // namespace

int hz(const Options& options) { return measure(What::kRate, options); }
int bw(const Options& options) { return measure(What::kBandwidth, options); }

}  // namespace ensonify::topic_tool
