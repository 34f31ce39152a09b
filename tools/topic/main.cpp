// ensonify topic: examines the topics of a live run, on the live plane only. list and info say what the registry and
// the schemas hold, echo prints messages, hz and bw measure how often and how much they come.
#include <CLI/CLI.hpp>
#include <string>
#include <utility>

#include "components/runtime/clock_client.h"
#include "components/runtime/tool.h"
#include "tools/topic/publish.h"
#include "tools/topic/verbs.h"

namespace ensonify::topic_tool {
namespace {

CLI::App* verb(CLI::App& app, Options& options, const std::string& name, const std::string& about) {
  CLI::App* sub = app.add_subcommand(name, about);
  add_run_option(*sub, options.run);
  sub->add_flag("--json", options.json, "JSON for scripts; times in ns or s, sizes in bytes, as the keys say");
  sub->add_option("TOPIC", options.topics, "topics, or patterns such as 'bow/*'");
  return sub;
}

CLI::App* listener(CLI::App& app, Options& options, const std::string& name, const std::string& about) {
  CLI::App* sub = verb(app, options, name, about);
  sub->get_option("TOPIC")->required();
  sub->add_option("--count,-n", options.count, "leave after so many messages in all (default: at the end of the run)");
  sub->add_option("--timeout", options.timeout_s, "leave after so long, wall s (default: at the end of the run)")
      ->check(CLI::Range(1e-3, 1e6));
  return sub;
}

void add_verbs(CLI::App& app, Options& options) {
  verb(app, options, "list", "every topic with type, declared rate and size, messages so far, subscribers");
  verb(app, options, "info", "one topic in full, with its fields and their units")->get_option("TOPIC")->required();
  CLI::App* echo = listener(app, options, "echo", "prints messages, arrays abbreviated");
  echo->add_option("--field", options.field, "only this field, e.g. range_m or position_enu_m.2");
  echo->add_flag("--full", options.full, "with --json: every element of every array");
  for (const auto& [name, about] : {std::pair{"hz", "how often: Hz in sim time and wall time, and the jitter of both"},
                                    {"bw", "how much: bytes per second of wall time and of sim time"}}) {
    listener(app, options, name, about)
        ->add_option("--window", options.window, "messages per topic that the rates are taken over")
        ->check(CLI::Range(2, 1'000'000))
        ->capture_default_str();
  }
}

void add_pub(CLI::App& app, Publication& publication) {
  CLI::App* pub = app.add_subcommand(
      "pub",
      "publishes a message again and again, as a participant that the launch file declares `external: true`\n"
      "and that has not joined. The run waits for it like for any participant, and it stays until the run ends: "
      "Ctrl-C\n"
      "ends both. Example: ensonify topic pub agent/command guidance/1 speed_mps=1.5 heading_grid_rad=0.3");
  add_run_option(*pub, publication.run);
  pub->add_option("TOPIC", publication.topic, "PROCESS/PORT, such as agent/command")->required();
  pub->add_option("TYPE", publication.type, "type of the message, such as guidance/1 (`ensonify describe --reference`)")
      ->required();
  pub->add_option("FIELD", publication.fields, "FIELD=VALUE, values as in YAML; other fields keep their defaults");
  pub->add_option("--rate", publication.rate_hz, "messages per second of sim time")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str();
  pub->add_option("--count,-n", publication.count, "publish so many (default: until the run ends)")
      ->check(CLI::PositiveNumber);
}

int run(const CLI::App& app, const Options& options) {
  const std::string name = app.get_subcommands().front()->get_name();
  if (name == "list") return list(options);
  if (name == "info") return info(options);
  if (name == "echo") return echo(options);
  if (name == "pub") return publish(options.publication);
  return name == "hz" ? hz(options) : bw(options);
}

}  // namespace
}  // namespace ensonify::topic_tool

int main(int argc, char** argv) {
  using namespace ensonify::topic_tool;
  CLI::App app(
      "Shows the topics of a live run, or publishes on one. What is shown can never slow the run: a slow reader loses\n"
      "messages instead, and is shown how many. Nothing is kept for a late one either: it sees what is published from\n"
      "then on; what was said before, such as a chart, only a record holds. Facts fixed for the run (launch, "
      "scenario,\n"
      "...) can be had at any time from `ensonify clock get`. The topic clock/health reports about once a second of "
      "wall\n"
      "time how the run keeps its pace.\n"
      "Exit code: 0 done, 1 fewer messages came than were asked for, 2 no such run, topic or field.",
      "ensonify topic");
  Options options;
  app.require_subcommand(1);
  add_verbs(app, options);
  add_pub(app, options.publication);
  return ensonify::tool_main(app, argc, argv, [&] { return run(app, options); });
}
