#include "launch/process/profiled_node.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "kernels/base/profile/profile.h"

namespace ensonify {
namespace {

using Json = nlohmann::ordered_json;

bool started = false;  // once in a process, whatever nodes it has

double seconds_of(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }
double microseconds_of(std::int64_t ns) { return 1e-3 * static_cast<double>(ns); }

/// https://docs.google.com/document/d/1CvAClvFfyA5R-PhYUmn5OOQtYMH4h6I0nSsKchNAySU: complete events and a name.
Json trace_events(const profile::Report& report, const std::string& process) {
  const int pid = ::getpid();
  Json events = Json::array();
  events.push_back({{"ph", "M"}, {"name", "process_name"}, {"pid", pid}, {"tid", 1}, {"args", {{"name", process}}}});
  for (const profile::Event& event : report.events) {
    events.push_back({{"ph", "X"},
                      {"name", profile::kStageNames[static_cast<std::size_t>(event.stage)]},
                      {"pid", pid},
                      {"tid", 1},
                      {"ts", microseconds_of(event.begin_ns)},
                      {"dur", microseconds_of(event.duration_ns)}});
  }
  return events;
}

}  // namespace

SimTime ProfiledNode::step(SimTime now) {
  if (!started) profile::start();
  started = true;
  const profile::Span span(profile::Stage::kStep);
  return node_->step(now);
}

void write_profile(const std::string& file, const std::string& process) {
  const profile::Report report = started ? profile::report() : profile::Report{};
  Json stages = Json::object();
  for (std::size_t i = 0; i < profile::kStages; ++i) {
    const profile::Sum& sum = report.sums[i];
    if (sum.count == 0) continue;
    stages[profile::kStageNames[i]] = {{"count", sum.count},
                                       {"wall_s", seconds_of(sum.wall_ns)},
                                       {"processor_s", seconds_of(sum.processor_ns)},
                                       {"items", sum.items},
                                       {"part_of_beamform", profile::is_part(static_cast<profile::Stage>(i))}};
  }
  const Json json = {{"process", process},
                     {"wall_s", seconds_of(report.end_ns - report.begin_ns)},
                     {"processor_s", seconds_of(report.processor_ns)},
                     {"stages", stages},
                     {"events_left_out", report.events_left_out},
                     {"traceEvents", trace_events(report, process)}};
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(file).parent_path(), ignored);
  std::ofstream stream(file);
  stream << json.dump() << '\n';
  stream.close();
  if (!stream) throw ExitError(kExitDataLost, file + ": cannot be written");
}

}  // namespace ensonify
