#include "tools/convert/replay_launch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "components/config/parameter_info.h"
#include "components/errors/exit_error.h"
#include "launch/file/launch_file.h"

namespace ensonify::convert {

namespace {

constexpr SimTime kAfterLast = 1_s;  // so that everybody has taken the last message

ConfigNode list_of(const std::vector<std::string>& words) {
  ConfigNode list;
  list.kind = ConfigNode::Kind::kList;
  for (const std::string& word : words) list.items.push_back(ConfigNode::text(word));
  return list;
}

/// The logger whose parameters hold.
RecordedLogger logger_of(const RecordedRun& run, const std::string& name) {
  std::vector<std::string> names;
  for (const RecordedLogger& logger : run.loggers) {
    if (logger.process == name) return logger;
    names.push_back(logger.process);
  }
  if (!name.empty())
    throw UserError(fmt::format("--logger {}: the run had no such logger; it had: {}", name,
                                names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  if (names.size() > 1)
    throw UserError(fmt::format("--logger: the run had several; name one of {}", fmt::join(names, ", ")));
  if (names.size() == 1) return run.loggers.front();
  std::string own = "log";
  while (run.publishers().contains(own)) own += "_";
  return {.process = own};
}

void wire(RecordedLogger& logger, const RecordedRun& run, const std::string& head) {
  std::erase_if(logger.wiring,
                [](const auto& edge) { return edge.first == "soundings" || edge.first == "seabed_image"; });
  for (const char* port : {"soundings", "seabed_image"}) {
    const std::string topic = head + "/" + port;
    if (run.has(topic)) logger.wiring.emplace_back(port, ConfigNode::text(topic));
  }
}

/// One of the recorded processes, saying again what loggers read.
ConfigNode replay(const RecordedRun& run, const std::string& process) {
  std::vector<std::string> topics;
  for (const auto& one : run.topics) {
    if (one.first.starts_with(process + "/")) topics.push_back(one.first);
  }
  ConfigNode config = ConfigNode::map();
  config.set("file", ConfigNode::text(run.file));
  config.set("topics", list_of(topics));
  ConfigNode stanza = ConfigNode::map();
  stanza.set("run", ConfigNode::text("replay"));
  stanza.set("config", std::move(config));
  return stanza;
}

}  // namespace

ReplayLaunch replay_launch(const RecordedRun& run, const Wanted& wanted, const std::string& scenario,
                           const std::string& folder) {
  RecordedLogger logger = logger_of(run, wanted.logger);
  const auto heads = run.heads();
  const bool stated = logger.config.find("head") != nullptr || logger.config.find("sidescan") != nullptr;
  const std::string head = wanted.head.empty() && !stated && heads.size() == 1 ? *heads.begin() : wanted.head;
  if (!head.empty()) {
    if (!heads.contains(head))
      throw UserError(fmt::format("--head {}: the record holds no soundings of it; it holds those of: {}", head,
                                  heads.empty() ? "none" : fmt::format("{}", fmt::join(heads, ", "))));
    logger.config.set("head", ConfigNode::text(head));
    wire(logger, run, head);
  }
  if (!wanted.sidescan && logger.config.find("sidescan") != nullptr)
    logger.config.set("sidescan", ConfigNode::text(""));
  logger.config.set("folder", ConfigNode::text(folder));
  if (logger.config.find("send") != nullptr) logger.config.set("send", list_of({}));  // it sent while it was live

  ConfigNode processes = ConfigNode::map();
  for (const std::string& process : run.publishers()) processes.set(process, replay(run, process));
  ConfigNode log = ConfigNode::map();
  log.set("run", ConfigNode::text("logger"));
  log.set("config", logger.config);
  processes.set(logger.process, std::move(log));

  ConfigNode root = ConfigNode::map();
  root.set("ensonify", ConfigNode::text(kLaunchFormat));
  root.set("scenario", ConfigNode::text(scenario));
  root.set("duration_s", ConfigNode::text(fmt::format("{:.9f}", seconds(run.end + kAfterLast))));
  root.set("processes", std::move(processes));
  ConfigNode wiring = ConfigNode::map();
  for (const auto& [port, topic] : logger.wiring) wiring.set(logger.process + "." + port, topic);
  if (!wiring.entries.empty()) root.set("wiring", std::move(wiring));
  const ConfigNode* own = logger.config.find("head");
  return {block_yaml(root), logger.process, own ? own->scalar : ""};
}

}  // namespace ensonify::convert
