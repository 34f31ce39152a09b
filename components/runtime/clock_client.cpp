#include "components/runtime/clock_client.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/run_finder.h"

namespace ensonify {

namespace {

using nlohmann::json;
using std::chrono::milliseconds;

constexpr milliseconds kPatience{5000};

TopicEntry read_topic(const json& from) {
  TopicEntry topic;
  topic.name = from.at("topic");
  topic.type = from.at("type");
  topic.publisher = from.at("publisher");
  topic.component = from.at("component");
  topic.max_bytes = from.at("max_bytes");
  topic.rate = {from.at("rate").at(0), from.at("rate").at(1)};
  topic.endpoint = from.at("live");
  topic.live_only = from.at("sync") == "";
  topic.published = from.at("published");
  for (const json& s : from.at("subscribers")) {
    topic.subscribers.push_back({s.at("process"), s.at("port"), SimTime{s.at("delay_ns").get<std::int64_t>()}});
  }
  return topic;
}

}  // namespace

RunRegistry read_registry(const json& answer) {
  RunRegistry registry;
  for (const json& process : answer.at("processes")) {
    registry.processes.push_back({process.at("name"), process.at("component")});
  }
  for (const json& topic : answer.at("topics")) registry.topics.push_back(read_topic(topic));
  return registry;
}

ClockClient::ClockClient(const LiveRun& run)
    : endpoint_(run.endpoint), keys_(bus::keys_for(run.endpoint, "", run.folder)), query_(endpoint_, keys_) {}

ClockClient::ClockClient(const std::string& run) : ClockClient(find_run(run)) {}

json ClockClient::ask(const json& request) {
  const std::string kind = request.at("kind");
  const auto text = query_.ask(request.dump(), kPatience);
  if (!text) {
    throw UserError(fmt::format(
        "the clock at {} has not answered for {} s: the run has ended, or hangs{}", endpoint_, kPatience.count() / 1000,
        keys_ || endpoint_.starts_with("ipc://") ? "" : ", or wants its keys ($ENSONIFY_KEYS)"));
  }
  const json answer = json::parse(*text, nullptr, false);
  if (!answer.is_object() || answer.value("kind", "") != kind) {
    throw UserError(fmt::format("{}: does not speak as a clock does", endpoint_));
  }
  if (answer.contains("error")) throw UserError(answer["error"].get<std::string>());
  return answer;
}

RunRegistry ClockClient::registry() {
  RunRegistry registry = read_registry(ask({{"kind", "registry"}}));
  if (!registry.processes.empty()) return registry;
  std::string missing;
  const json status = ask({{"kind", "status"}});
  for (const std::string& name : status.value("missing", std::vector<std::string>{})) missing += " " + name;
  throw UserError("the run is still connecting, waiting for" + (missing.empty() ? " nobody: ask again" : missing));
}

void add_run_option(CLI::App& app, std::string& run) {
  app.add_option("--run", run,
                 "a live run: its name, its directory, the id of that, or its clock's endpoint (default: "
                 "$ENSONIFY_RUN, else the only live run)");
}

}  // namespace ensonify
