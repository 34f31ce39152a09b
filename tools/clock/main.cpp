// ensonify clock: asks a live run's clock, and steers it.
#include <fmt/format.h>
#include <poll.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/runtime/clock_client.h"
#include "components/runtime/run_finder.h"
#include "components/runtime/tool.h"
#include "tools/clock/status_text.h"

namespace {

using namespace ensonify;
using nlohmann::json;
using std::chrono::steady_clock;

struct Options {
  std::string run;
  bool json = false;
  double step_s = 0.0;
  double patience_s = 60.0;
  double rate = 1.0;
  std::string what;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> sets;
  std::string out;
};

void print_answer(const json& answer, bool as_json, const std::string& text) {
  fmt::print("{}\n", as_json ? answer.dump() : text);
}

int status(ClockClient& clock, const Options& options) {
  const json answer = clock.ask({{"kind", "status"}});
  if (options.json) fmt::print("{}\n", answer.dump());
  else fmt::print("{}", clock_tool::status_text(answer));
  return kExitOk;
}

int request(ClockClient& clock, const Options& options, const json& what, const std::string& done) {
  print_answer(clock.ask(what), options.json, done);
  return kExitOk;
}

/// Nobody has an event left at or before `until`, or there will be no more events.
bool reached(const json& status, std::int64_t until_ns) {
  const std::string state = status.at("state");
  return state == "done" || state == "failed" || status.at("sim_ns").is_null() || status.at("sim_ns") > until_ns;
}

/// Comes back once sim time has advanced.
int step(ClockClient& clock, const Options& options) {
  constexpr int kAskEvery_ms = 5;
  const auto ns = from_seconds(options.step_s).count();
  if (ns < 1) throw UserError("step: takes at least 1e-9 s of sim time");
  const std::int64_t until_ns = clock.ask({{"kind", "step"}, {"ns", ns}}).at("until_ns");
  const auto patience_end = steady_clock::now() + std::chrono::duration<double>(options.patience_s);
  json now = clock.ask({{"kind", "status"}});
  while (!reached(now, until_ns) && !interrupted()) {
    if (steady_clock::now() > patience_end) {
      fmt::print(stderr,
                 "ensonify clock: t={:.9g} s was not reached within {} s; `ensonify clock status` says who holds "
                 "the run up\n",
                 1e-9 * static_cast<double>(until_ns), options.patience_s);
      return kExitStall;
    }
    ::poll(nullptr, 0, kAskEvery_ms);
    now = clock.ask({{"kind", "status"}});
  }
  print_answer({{"kind", "step"}, {"ok", true}, {"until_ns", until_ns}}, options.json,
               fmt::format("paused at t={:.9g} s", 1e-9 * static_cast<double>(until_ns)));
  return kExitOk;
}

int reset(ClockClient& clock, const Options& options) {
  json sets = options.sets;
  if (options.seed) sets.push_back(fmt::format("seed={}", *options.seed));
  const std::string out = options.out.empty() ? "" : std::filesystem::absolute(options.out).string();
  const json answer = clock.ask({{"kind", "reset"}, {"set", sets}, {"out", out}});
  print_answer(answer, options.json,
               fmt::format("epoch {} begins; results in {}", answer.at("epoch").get<int>(),
                           answer.at("out").get<std::string>()));
  return kExitOk;
}

int get(ClockClient& clock, const Options& options) {
  json what = {{"kind", "get"}};
  if (!options.what.empty()) what["what"] = options.what;
  json answer;
  try {
    answer = clock.ask(what);
  } catch (const UserError& e) {
    if (options.what.empty()) throw;
    std::string known;
    const json facts = clock.ask({{"kind", "get"}});
    for (const json& fact : facts.at("facts")) known += " " + fact.get<std::string>();
    throw UserError(options.what + ": " + e.what() + "; known:" + known);
  }
  std::string text;
  if (answer.contains("text")) {
    text = answer["text"];
    if (text.ends_with('\n')) text.pop_back();
  } else {
    for (const json& fact : answer.at("facts")) text += (text.empty() ? "" : "\n") + fact.get<std::string>();
  }
  print_answer(answer, options.json, text);
  return kExitOk;
}

CLI::App* verb(CLI::App& app, Options& options, const std::string& name, const std::string& about) {
  CLI::App* sub = app.add_subcommand(name, about);
  add_run_option(*sub, options.run);
  sub->add_flag("--json", options.json, "print the clock's answer as JSON; times in ns of sim time");
  return sub;
}

int list(const Options& options) {
  auto all = nlohmann::ordered_json::array();
  for (const LiveRun& run : live_runs(runs_folder())) {
    all.push_back({{"run", run.id()},
                   {"launch", run.about.launch},
                   {"out", run.about.out},
                   {"began_unix_s", run.about.began_unix_s},
                   {"process", run.about.process},
                   {"folder", run.folder},
                   {"clock", run.endpoint}});
    if (!options.json) fmt::print("{}: {}; results in {}\n", run.id(), run.about.text(), run.about.out);
  }
  if (options.json) fmt::print("{}\n", all.dump());
  else if (all.empty()) fmt::print("no run is live\n");
  return kExitOk;
}

int run(const CLI::App& app, const Options& options) {
  if (app.get_subcommands().front()->get_name() == "list") return list(options);
  ClockClient clock(options.run);
  const auto rate = [&](double r, const std::string& done) {
    return request(clock, options, {{"kind", "rate"}, {"rate", r}}, done);
  };
  const std::string name = app.get_subcommands().front()->get_name();
  if (name == "status") return status(clock, options);
  if (name == "pause") return request(clock, options, {{"kind", "pause"}}, "paused");
  if (name == "resume") return request(clock, options, {{"kind", "resume"}}, "resumed");
  if (name == "step") return step(clock, options);
  if (name == "rate") return rate(options.rate, fmt::format("paced at {:g}x", options.rate));
  if (name == "free") return rate(0.0, "free running");
  if (name == "get") return get(clock, options);
  if (name == "reset") return reset(clock, options);
  return request(clock, options, {{"kind", "stop"}}, "ending the run in order");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Asks the clock of a live run, and steers it.\n"
      "Exit code: 0 done, 2 no such run or fact, or a reset that cannot be, 4 a step was not reached in time.",
      "ensonify clock");
  Options options;
  app.require_subcommand(1);
  verb(app, options, "status",
       "state, sim time, rate, and per participant: next event, cost, lateness, who it waits for");
  app.add_subcommand("list", "live runs of this user: name, launch file, age, folder of results")
      ->add_flag("--json", options.json, "as JSON, with folder and clock of each");
  verb(app, options, "pause", "no event after those granted already runs until resume or step");
  verb(app, options, "resume", "goes on after a pause, at the rate in force");
  CLI::App* step = verb(app, options, "step", "pauses, lets sim time advance by SECONDS, comes back when it has");
  step->add_option("SECONDS", options.step_s, "sim time to advance by, s")->required()->check(CLI::Range(1e-9, 1e6));
  step->add_option("--timeout", options.patience_s, "longest wait, wall s")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  CLI::App* rate = verb(app, options, "rate", "paces the run");
  rate->add_option("RATE", options.rate, "sim seconds per wall second")->required()->check(CLI::Range(1e-3, 1e6));
  verb(app, options, "free", "runs as fast as possible");
  CLI::App* reset =
      verb(app, options, "reset", "ends the epoch in order and begins another in the same processes, at sim time 0");
  reset->add_option("--seed", options.seed, "seed of the epoch's scenario");
  reset->add_option("--set", options.sets,
                    "parameter of the scenario or of a process, KEY=VALUE, behind those of the run");
  reset->add_option("--out", options.out, "folder of the epoch's results (default: epochs/N in that of the run)");
  verb(app, options, "stop", "ends the run in order, with exit code 0");
  CLI::App* get = verb(app, options, "get", "a fact fixed for the run, as text; without WHAT, the names of all facts");
  get->add_option("WHAT", options.what, "launch, scenario, seed, start_utc, external, version, or a process's own");
  return tool_main(app, argc, argv, [&] { return run(app, options); });
}
