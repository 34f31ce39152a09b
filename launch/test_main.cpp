// ensonify-test: runs launch files as tests.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"
#include "components/errors/printable.h"
#include "components/runtime/tool.h"
#include "launch/batch/find.h"
#include "launch/batch/merge.h"
#include "launch/batch/pool.h"
#include "launch/batch/results.h"
#include "launch/junit.h"
#include "launch/run_dir.h"

namespace {

using namespace ensonify;
using namespace ensonify::batch;
using nlohmann::ordered_json;

/// A run keeps one processor busy, and its sockets and threads a part of another.
constexpr std::size_t kProcessorsPerRun = 2;

struct Options {
  std::vector<std::string> paths, merge;
  FindOptions find;
  std::size_t jobs = std::max<std::size_t>(1, std::thread::hardware_concurrency() / kProcessorsPerRun);
  std::string out = "out/test", junit, shard;
  double rate = 0.0, timeout_s = 3600.0;
  bool json = false, list = false, resume = false;
};

void declare(CLI::App& app, Options& options) {
  auto* paths =
      app.add_option("PATH", options.paths, "launch files, and folders whose launch files with `expect:` are run");
  app.add_option("--jobs,-j", options.jobs, "runs at once (default: half the processors, as each run takes about two)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--out", options.out, "folder of results; runs/ID has those of each run (default: out/test)");
  app.add_option("--junit", options.junit, "write all results as JUnit XML to this file");
  app.add_option("--arg", options.find.args, "NAME=VALUE: an argument, for the launch files that have it")
      ->allow_extra_args(false);  // a launch file may follow
  app.add_option("--set", options.find.sets, "KEY=VALUE: as of `ensonify run`, for every launch")
      ->allow_extra_args(false);
  app.add_option("--filter", options.find.text, "only launch files whose path holds this text");
  app.add_option("--rate", options.rate, "sim seconds per wall second (default: as fast as possible)")
      ->check(CLI::Range(1e-3, 1e6));
  app.add_option("--timeout-s", options.timeout_s,
                 "wall time after which a run is ended and has failed (default: 3600)")
      ->check(CLI::Range(0.1, 1e6));
  app.add_option("--shard", options.shard, "I/N: only every N-th launch, from the I-th on, of 1 to N");
  app.add_option(
         "--merge", options.merge,
         "folders of all shards: check that they belong together and nothing is missing, and join them in --out")
      ->excludes(paths);
  app.add_flag("--resume", options.resume, "go on with --out: what is done and has not changed is not run again");
  app.add_flag("--list", options.list, "say what would be run, and run nothing");
  app.add_flag("--json", options.json, "print results as JSON on standard output");
  app.footer(
      "Exit codes: 0 all passed, 1 an expectation failed and nothing worse, 2 arguments or files are wrong, 3 to 6 "
      "that of\n"
      "the first run that ended so (3 also for a run that took too long), 130 after Ctrl-C. A launch file that needs "
      "an\n"
      "argument, or waits for a process that somebody else starts, is skipped.");
}

std::vector<Job> own_part(const std::vector<Job>& plan, const std::string& shard) {
  if (shard.empty()) return plan;
  std::size_t part = 0, parts = 0;
  char rest = 0;
  if (std::sscanf(shard.c_str(), "%zu/%zu%c", &part, &parts, &rest) != 2 || part < 1 || part > parts)
    throw UserError("--shard " + shard + ": allowed: I/N with I from 1 to N");
  return shard_of(plan, part, parts);
}

const char* meaning_of(int code) {
  switch (code) {
    case Result::kTimedOut: return "it took longer than --timeout-s";
    case kExitAssertionFailed: return "an expectation failed, or a mission was given up";
    case kExitUserError: return "files or arguments are wrong";
    case kExitDied: return "a process died";
    case kExitStall: return "no progress";
    case kExitDataLost: return "data lost";
    case kExitDiffer: return "runs differ";
    case kExitInterrupted: return "it was interrupted";
    default: return "unknown";
  }
}

std::string command_of(const Job& job, const Options& options) {
  std::string command =
      "ensonify run " + job.options.file + (options.rate > 0.0 ? fmt::format(" --rate {}", options.rate) : " --free");
  for (const std::string& arg : job.options.args) command += " --arg " + arg;
  for (const std::string& set : job.options.sets) command += " --set " + set;
  return command;
}

std::string reason_of(const Result& result) {
  const bool timed_out = result.exit_code == Result::kTimedOut;
  return timed_out || result.message.empty() ? meaning_of(result.exit_code) : result.message;
}

/// What a reader needs of one run.
std::string lines_of(const Result& result, const Job& job, const Folder& folder, const Options& options) {
  const std::size_t all = result.expectations.size();
  std::string lines = fmt::format("{:<6}  {}  ({} of {} expectations, {:.1f} s of sim time in {:.1f} s)\n",
                                  result.passed() ? "passed" : "FAILED", job.label, all - result.failed(), all,
                                  result.sim_s, result.wall_s);
  if (result.passed()) return lines;
  for (const auto& one : result.expectations) {
    if (!one.ok) lines += fmt::format("        failed: {}: {} (t={:.3f} s)\n", one.name, one.message, one.t_s);
  }
  const bool said = result.exit_code == kExitAssertionFailed && result.failed() > 0;
  if (!said) {
    std::string why = reason_of(result);
    if (!result.culprit.empty() && result.exit_code != Result::kTimedOut && !why.starts_with(result.culprit))
      why = result.culprit + " " + why;
    lines += fmt::format("        exit code {}: {}\n",
                         result.exit_code == Result::kTimedOut ? int{kExitDied} : result.exit_code, why);
  }
  return lines + fmt::format("        alone: {}; logs: {}/log\n", command_of(job, options), folder.run_of(job));
}

std::string junit_of(const std::vector<Found>& found, const std::vector<Job>& jobs, const Folder& folder) {
  std::string suites;
  for (const Found& one : found) {
    if (!one.skipped.empty()) {
      suites +=
          launcher::junit::test_suite(one.file, 1, 0, launcher::junit::skipped_case(one.file, "run", one.skipped));
    } else if (!one.fault.empty()) {
      suites +=
          launcher::junit::test_suite(one.file, 1, 1, launcher::junit::test_case(one.file, "run", 0.0, one.fault));
    }
  }
  for (const Job& job : jobs) {
    const auto result = folder.result_of(job);
    if (!result) continue;
    std::string cases;
    for (const auto& one : result->expectations) {
      const std::string message = one.message.empty() ? "not fulfilled" : one.message;
      cases += launcher::junit::test_case(job.label, one.name, one.t_s, one.ok ? "" : message);
    }
    const bool run_failed = !result->passed() && !(result->exit_code == kExitAssertionFailed && result->failed() > 0);
    const std::string why = reason_of(*result);
    cases += launcher::junit::test_case(job.label, "run", result->wall_s, run_failed ? why : "");
    suites += launcher::junit::test_suite(job.label, result->expectations.size() + 1,
                                          result->failed() + (run_failed ? 1 : 0), cases);
  }
  return launcher::junit::document(suites);
}

/// Without a folder: what would be run, and the arguments that each has.
ordered_json json_of(const std::vector<Found>& found, const std::vector<Job>& jobs, const Folder* folder) {
  ordered_json launches = ordered_json::array();
  std::map<std::string, std::vector<std::string>> args;
  for (const Found& one : found) {
    args[one.file] = one.args;
    if (!one.skipped.empty())
      launches.push_back({{"launch", one.file}, {"args", one.args}, {"verdict", "skipped"}, {"why", one.skipped}});
    if (!one.fault.empty())
      launches.push_back({{"launch", one.file}, {"args", one.args}, {"verdict", "unreadable"}, {"why", one.fault}});
  }
  for (const Job& job : jobs) {
    ordered_json entry = {{"launch", job.label}, {"args", args[job.label]}, {"id", job.id}};
    const auto result = folder != nullptr ? folder->result_of(job) : std::nullopt;
    if (folder == nullptr || !result) {
      entry["verdict"] = folder == nullptr ? "listed" : "not run";
    } else {
      entry["verdict"] = result->passed() ? "passed" : "failed";
      entry["exit_code"] = result->exit_code;
      entry["sim_s"] = result->sim_s, entry["wall_s"] = result->wall_s;
      entry["message"] = result->message;
      entry["out"] = folder->run_of(job);
      entry["expect"] = ordered_json::array();
      for (const auto& item : result->expectations)
        entry["expect"].push_back({{"name", item.name}, {"ok", item.ok}, {"t_s", item.t_s}, {"message", item.message}});
    }
    launches.push_back(std::move(entry));
  }
  return {{"launches", launches}};
}

/// Those that can be run, each once: two files may be the same launch.
std::vector<Job> plan_of(const std::vector<Found>& found) {
  std::vector<Job> plan;
  std::set<std::string> ids;
  for (const Found& one : found) {
    if (one.skipped.empty() && one.fault.empty() && ids.insert(one.job.id).second) plan.push_back(one.job);
  }
  return plan;
}

/// The first fault decides; an expectation that failed counts only without one.
int exit_code_of(const std::vector<Found>& found, const std::vector<Job>& jobs, const Folder& folder) {
  int code = std::ranges::any_of(found, [](const Found& one) { return !one.fault.empty(); }) ? kExitUserError : kExitOk;
  for (const Job& job : jobs) {
    const auto result = folder.result_of(job);
    if (!result || result->passed()) continue;
    const int own = result->exit_code == Result::kTimedOut ? int{kExitDied} : result->exit_code;
    if (code == kExitOk || code == kExitAssertionFailed) code = own;
  }
  return code;
}

void say_not_run(const std::vector<Found>& found) {
  for (const Found& one : found) {
    if (!one.skipped.empty()) fmt::print("skipped {}  ({})\n", one.file, printable(one.skipped));
    if (!one.fault.empty()) fmt::print(stderr, "{}\n", printable(one.fault));
  }
}

/// What is written and said when all is done.
int report(const std::vector<Found>& found, const std::vector<Job>& jobs, const Folder& folder, const Options& options,
           std::chrono::steady_clock::time_point began) {
  folder.write_table(jobs);
  if (!options.junit.empty()) launcher::write_text(options.junit, junit_of(found, jobs, folder));
  if (options.json)
    fmt::print("{}\n", json_of(found, jobs, &folder).dump(2, ' ', false, ordered_json::error_handler_t::replace));
  std::size_t passed = 0, failed = 0;
  for (const Job& job : jobs) {
    if (const auto result = folder.result_of(job)) ++(result->passed() ? passed : failed);
  }
  const auto not_run =
      static_cast<std::size_t>(std::ranges::count_if(found, [](const Found& one) { return !one.skipped.empty(); }));
  const auto unreadable =
      static_cast<std::size_t>(std::ranges::count_if(found, [](const Found& one) { return !one.fault.empty(); }));
  fmt::print(options.json ? stderr : stdout, "{} passed, {} failed, {} skipped{} in {:.1f} s; results in {}\n", passed,
             failed, not_run, unreadable > 0 ? fmt::format(", {} unreadable", unreadable) : "",
             std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(), options.out);
  return exit_code_of(found, jobs, folder);
}

/// The folders of shards as the one of a batch. Nobody writes into any of them meanwhile.
int merge(const Options& options) {
  const auto began = std::chrono::steady_clock::now();
  std::vector<std::unique_ptr<launcher::OutFolder>> held;
  for (const std::string& part : options.merge) {
    std::error_code ignored;
    if (std::filesystem::equivalent(part, options.out, ignored))
      throw UserError("--out " + options.out + ": is one of the shards; choose another folder");
    if (std::filesystem::is_directory(part)) held.push_back(std::make_unique<launcher::OutFolder>(part));
  }
  const Shards shards = read_shards(options.merge);
  held.push_back(std::make_unique<launcher::OutFolder>(options.out));
  Folder::forget(options.out);
  put_together(shards, options.out);
  const Folder folder(options.out, shards.plan);
  for (const Job& job : shards.plan) {
    if (!options.json) fmt::print("{}", printable(lines_of(*folder.result_of(job), job, folder, options)));
  }
  return report({}, shards.plan, folder, options, began);
}

int test(const Options& options) {
  if (!options.merge.empty()) return merge(options);
  if (options.paths.empty()) throw UserError("names no launch; allowed: launch files and folders, or --merge");
  const std::vector<Found> found = find_launches(options.paths, options.find, program_folder());
  const std::vector<Job> plan = plan_of(found), jobs = own_part(plan, options.shard);
  if (options.list) {
    if (options.json) fmt::print("{}\n", json_of(found, jobs, nullptr).dump(2));
    else say_not_run(found);
    for (const Job& job : jobs) {
      if (!options.json) fmt::print("{}\n", job.label);
    }
    return std::ranges::any_of(found, [](const Found& one) { return !one.fault.empty(); }) ? kExitUserError : kExitOk;
  }
  if (!options.json) say_not_run(found);
  const launcher::OutFolder held(options.out);
  if (!options.resume) Folder::forget(options.out);
  const Folder folder(options.out, plan);
  PoolSettings settings{.at_once = options.jobs, .program_folder = program_folder()};
  settings.longest = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * options.timeout_s));
  settings.run_words = options.rate > 0.0 ? std::vector<std::string>{"--rate", fmt::format("{}", options.rate)}
                                          : std::vector<std::string>{"--free"};
  const auto began = std::chrono::steady_clock::now();
  const auto say = [&](const Job& job) {
    if (options.json) return true;
    fmt::print("{}", printable(lines_of(*folder.result_of(job), job, folder, options)));
    std::fflush(stdout);
    return true;
  };
  for (const Job& job : jobs) {
    if (folder.result_of(job)) say(job);
  }
  const bool whole = run_jobs(jobs, folder, settings, say);
  const int code = report(found, jobs, folder, options, began);
  return whole ? code : int{kExitInterrupted};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("ensonify test: runs launch files as tests, several at once, and says which of them hold.");
  app.name("ensonify test");
  Options options;
  declare(app, options);
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  try {
    return test(options);
  } catch (const ExitError& error) {
    fmt::print(stderr, "{}\n", printable(error.what()));
    return error.code;
  } catch (const std::exception& error) {
    fmt::print(stderr, "ensonify test: {}\n", error.what());
    return kExitDied;
  }
}
