#include "tools/convert/recorded_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/config/parse_yaml.h"
#include "components/errors/exit_error.h"
#include "components/record/reader.h"
#include "components/runtime/tool.h"

namespace ensonify::convert {

namespace {

const std::set<std::string> kRead{"soundings/1", "seabed_image/1", "ping/1",  "bottom_track/1", "estimate/1",
                                  "attitude/1",  "position/1",     "chart/1", "mission_state/1"};

std::string process_of(const std::string& topic) { return topic.substr(0, topic.find('/')); }

std::string text_of(const record::RecordReader& reader, const std::string& name) {
  const auto& files = reader.attachments();
  const auto found = std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.name == name; });
  return found == files.end() ? std::string() : found->data;
}

/// A connection as launch files have it; records have its delay in nanoseconds.
ConfigNode in_launch_file(const ConfigNode& edge) {
  ConfigNode written = ConfigNode::map();
  for (const auto& entry : edge.entries) {
    if (entry.key == "delay_ns")
      written.set("delay_ms", ConfigNode::text(fmt::format("{}", std::stod(entry.value.scalar) * 1e-6)));
    else written.set(entry.key, entry.value);
  }
  return written;
}

/// Of a launch file as records hold it.
std::vector<RecordedLogger> loggers_of(const std::string& launch, const std::string& file) {
  std::vector<RecordedLogger> loggers;
  if (launch.empty()) return loggers;
  const ConfigDocument document = parse_config(launch, file + ": launch.yaml");
  const ConfigNode* processes = document.root.find("processes");
  if (processes == nullptr) return loggers;
  for (const auto& process : processes->entries) {
    const ConfigNode* run = process.value.find("run");
    if (run == nullptr || run->scalar != "logger") continue;
    RecordedLogger& logger = loggers.emplace_back(RecordedLogger{.process = process.key});
    if (const ConfigNode* config = process.value.find("config")) logger.config = *config;
    const ConfigNode* wiring = document.root.find("wiring");
    if (wiring == nullptr) continue;
    for (const auto& edge : wiring->entries) {
      if (edge.key.starts_with(process.key + "."))
        logger.wiring.emplace_back(edge.key.substr(process.key.size() + 1), in_launch_file(edge.value));
    }
  }
  return loggers;
}

}  // namespace

bool RecordedRun::has(const std::string& topic) const {
  return std::any_of(topics.begin(), topics.end(), [&](const auto& one) { return one.first == topic; });
}

std::set<std::string> RecordedRun::publishers() const {
  std::set<std::string> processes;
  for (const auto& one : topics) processes.insert(process_of(one.first));
  return processes;
}

std::set<std::string> RecordedRun::heads() const {
  std::set<std::string> heads;
  for (const auto& [topic, type] : topics) {
    if (type == "soundings/1") heads.insert(process_of(topic));
  }
  return heads;
}

RecordedRun recorded_run(const std::string& file) {
  RecordedRun run{.file = file};
  record::RecordReader reader(file);
  record::RecordedMessage message;
  while (!interrupted() && reader.next(message)) {
    run.end = std::max(run.end, message.t_sim);
    if (kRead.contains(message.channel->type)) run.topics.emplace(message.channel->topic, message.channel->type);
  }
  run.truncated = reader.truncated();
  run.scenario = text_of(reader, "scenario.yaml");
  if (run.scenario.empty())
    throw UserError(file +
                    ": says nothing of its scenario, in which origin, start and mounting stand; allowed: a record of a "
                    "launch with a scenario");
  run.loggers = loggers_of(text_of(reader, "launch.yaml"), file);
  return run;
}

}  // namespace ensonify::convert
