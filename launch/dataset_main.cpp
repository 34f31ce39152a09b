// ensonify-dataset: labelled pictures by the thousand from a recipe of scenes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <thread>

#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"
#include "components/errors/printable.h"
#include "components/runtime/tool.h"
#include "launch/batch/pool.h"
#include "launch/batch/results.h"
#include "launch/commands.h"
#include "launch/dataset/picture_makers.h"
#include "launch/dataset/plan.h"
#include "launch/run_dir.h"
#include "scenarios/world/world.h"

namespace {

using namespace ensonify;
using namespace ensonify::dataset;
namespace fs = std::filesystem;

constexpr std::size_t kRunsPerMaker = 4;  // at once: a run takes that much longer than its pictures

struct Options {
  std::string recipe, out, shard, check;
  std::uint64_t pictures = 1000;
  std::optional<std::uint64_t> only;
  std::size_t jobs = std::max<std::size_t>(1, std::thread::hardware_concurrency() / 2);
  double timeout_s = 3600.0;
  std::vector<std::string> merge;
  bool keep = false;
};

void declare(CLI::App& app, Options& options) {
  app.add_option("RECIPE", options.recipe, "recipe file: what is drawn, how often, in which formats");
  app.add_option("-n", options.pictures, "number of pictures (default: 1000)")->check(CLI::Range(1, 10'000'000));
  app.add_option("--out,-o", options.out, "folder of the set; it becomes OUT/set");
  app.add_option("--jobs,-j", options.jobs, "scenes at once (default: half the processors)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--only", options.only, "make picture K alone: it is the one that the whole set has");
  app.add_option("--shard", options.shard, "I/N: run only every N-th scene, from the I-th on; --merge joins them");
  app.add_option("--merge", options.merge, "folders of shards: check that nothing is missing and join them in --out");
  app.add_option("--timeout-s", options.timeout_s,
                 "wall time after which a scene is ended and has failed (default: 3600)")
      ->check(CLI::Range(0.1, 1e6));
  app.add_flag("--keep-runs", options.keep, "keep the record of each scene");
  app.add_option("--check", options.check,
                 "check a finished set: nothing leaks from one split to another (exit code 1)");
  app.footer(
      "What was interrupted goes on when it is called again; the set is the same. Exit codes: 0 made, 1 --check found\n"
      "a leak, 2 recipe or arguments are wrong, 3 to 6 that of the first scene that failed, 130 after Ctrl-C.");
}

int python(std::vector<std::string> words) {
  launcher::Command command;
  command.argv = {launcher::find_program("python3"), "-m", "ensonify.dataset"};
  if (command.argv[0].empty()) throw UserError("python3 is not on the PATH; it makes the pictures");
  command.argv.insert(command.argv.end(), words.begin(), words.end());
  return launcher::run_to_end(command);
}

/// Draws the scenes, and reads the launches of the first one as runs will: what else decides the results, for its id.
struct Drawing {
  Recipe recipe;
  std::vector<Scene> scenes;
  std::string base;
  bool same_ground = false;
};

void read_first(Drawing& of, const std::string& out) {
  const Recipe& recipe = of.recipe;
  const auto read = [&](const Scene& scene) {
    const LaunchOptions options{.file = recipe.launch, .args = scene.args, .sets = scene.sets, .out = out};
    return read_launch(options, [](ConfigReader& from, const std::string& scenario) { read_world(from, scenario); });
  };
  const Scene first = draw_scene(recipe, 0);
  const Launch launch = read(first);
  for (const Scene& pair : pairs_of(recipe, first)) read(pair);
  const auto head = std::ranges::find(launch.processes, recipe.head, &ProcessSpec::name);
  if (head == launch.processes.end())
    throw UserError(fmt::format("{}: head: {} has no process {}", recipe.file, recipe.launch, recipe.head));
  const ConfigNode* labels = head->config.root.find("labels");
  if (labels == nullptr || labels->scalar == "none")
    throw UserError(fmt::format("{}: head: {} has no `labels: masks` in {}", recipe.file, recipe.head, recipe.launch));
  if (recipe.picture.mask == "response" && labels->scalar != "energies")
    throw UserError(fmt::format("{}: picture.mask: response needs `labels: energies` of {}, and its topic recorded",
                                recipe.file, recipe.head));
  of.base = batch::id_of(launch, program_folder());
  const ConfigNode* seabed = launch.scenario.document.root.find("seabed");
  of.same_ground = seabed == nullptr || seabed->find("kind") == nullptr || seabed->find("kind")->scalar != "layers";
}

Drawing draw_all(const Options& options) {
  Drawing of{.recipe = read_recipe(options.recipe)};
  read_first(of, options.out);
  const Extent extent =
      options.only ? Extent::around(of.recipe, *options.only) : Extent::of(of.recipe, options.pictures);
  const auto none = options.only ? std::vector<std::string>{} : empty_splits(of.recipe, extent.scenes);
  if (!none.empty())
    throw UserError(
        fmt::format("{}: splits.{}: has none of {} scenes; more pictures, fewer `samples` or a larger share",
                    of.recipe.file, none[0], extent.scenes));
  for (std::uint64_t i = 0; i < extent.scenes; ++i) {
    const Scene scene = draw_scene(of.recipe, extent.first_scene + i);
    of.scenes.push_back(scene);
    std::ranges::move(pairs_of(of.recipe, scene), std::back_inserter(of.scenes));
  }
  return of;
}

std::vector<batch::Job> own_part(const std::vector<batch::Job>& plan, const std::string& shard) {
  if (shard.empty()) return plan;
  std::size_t part = 0, parts = 0;
  char rest = 0;
  if (std::sscanf(shard.c_str(), "%zu/%zu%c", &part, &parts, &rest) != 2 || part < 1 || part > parts)
    throw UserError("--shard " + shard + ": allowed: I/N with I from 1 to N");
  return batch::shard_of(plan, part, parts);
}

/// "7 of 100 scenes, 3 min left", once a second at most.
class Progress {
 public:
  explicit Progress(std::size_t all, std::size_t done) : all_(all), done_(done) {}

  void one_more() {
    ++done_, ++here_;
    const auto now = Clock::now();
    if (done_ < all_ && now - said_ < std::chrono::seconds(1)) return;
    said_ = now;
    const double each_s = std::chrono::duration<double>(now - began_).count() / static_cast<double>(here_);
    fmt::print(stderr, "{} of {} scenes, {:.1f} min left\n", done_, all_,
               each_s * static_cast<double>(all_ - done_) / 60);
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t all_, done_, here_ = 0;
  Clock::time_point began_ = Clock::now(), said_;
};

std::string why(const batch::Result& result, const std::string& log) {
  if (result.exit_code == batch::Result::kTimedOut) return "took longer than --timeout-s";
  std::string said = launcher::tail(log, 5);
  if (said.empty()) said = result.culprit + " " + result.message;
  return fmt::format("exit code {}: {}", result.exit_code, said);
}

/// Jobs whose pictures are there. What else has ended runs again.
std::size_t count_done(const std::vector<batch::Job>& jobs, const batch::Folder& folder) {
  std::size_t done = 0;
  for (const batch::Job& job : jobs) {
    const auto result = folder.result_of(job);
    if (result && result->passed() && fs::exists(folder.run_of(job) + "/pictures.npz")) {
      ++done;
    } else if (result) {
      folder.undo(job);
    }
  }
  return done;
}

/// Runs the scenes that are not done yet, and makes their pictures. The exit code of the first that fails, after which
/// none is begun. scene_of: its line of the plan.
int run_scenes(const std::vector<batch::Job>& jobs, const std::map<std::string, std::string>& scene_of,
               const batch::Folder& folder, const Options& options) {
  const std::size_t done = count_done(jobs, folder);
  if (done == jobs.size()) return kExitOk;
  batch::PoolSettings settings{.at_once = options.jobs, .program_folder = program_folder(), .run_words = {"--free"}};
  settings.longest = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * options.timeout_s));
  Progress progress(jobs.size(), done);
  PictureMakers makers(folder.path(), (options.jobs + kRunsPerMaker - 1) / kRunsPerMaker, options.keep);
  int code = kExitOk;
  const auto pictures = [&](const auto& act) {
    try {
      act();
    } catch (const ExitError& error) {
      if (code == kExitOk) fmt::print(stderr, "{}\n", printable(error.what()));
      if (code == kExitOk) code = error.code;
    }
  };
  const bool whole = batch::run_jobs(jobs, folder, settings, [&](const batch::Job& job) {
    const batch::Result result = *folder.result_of(job);
    if (result.passed()) {
      progress.one_more();
      pictures([&] { makers.make(scene_of.at(job.id)); });
    } else if (code == kExitOk) {
      code = result.exit_code == batch::Result::kTimedOut ? int{kExitDied} : result.exit_code;
      fmt::print(stderr, "{}\n",
                 printable(fmt::format("{}: {}; logs: {}/log", job.label, why(result, folder.run_of(job) + "/run.err"),
                                       folder.run_of(job))));
    }
    return code == kExitOk;
  });
  pictures([&] { makers.finish(); });
  return whole ? code : int{kExitInterrupted};
}

int make(const Options& options) {
  if (options.recipe.empty() || options.out.empty()) throw UserError("give RECIPE and --out DIR, or --check DIR");
  if (const int code = python({"ready"}); code != kExitOk) return code;
  const Drawing of = draw_all(options);
  const std::vector<batch::Job> plan = jobs_of(of.recipe, of.scenes, of.base);
  const std::vector<std::string> lines = lines_of(of.scenes, plan, of.same_ground);
  const std::vector<batch::Job> jobs = own_part(plan, options.shard);
  const launcher::OutFolder held(options.out);
  const batch::Folder folder(options.out, plan);
  if (fs::exists(options.out + "/set/manifest.jsonl")) {
    fmt::print("{}/set is whole already\n", options.out);
    return kExitOk;
  }
  write_plan(of.recipe, lines, options.out);
  if (options.merge.empty()) {
    std::map<std::string, std::string> scene_of;
    for (std::size_t i = 0; i < plan.size(); ++i) scene_of[plan[i].id] = lines[i];
    if (const int code = run_scenes(jobs, scene_of, folder, options); code != kExitOk) return code;
    if (!options.shard.empty()) {
      fmt::print("{} of {} scenes are in {}; `--merge` with the folders of all shards joins them\n", jobs.size(),
                 plan.size(), options.out);
      return kExitOk;
    }
  }
  std::vector<std::string> join{"join", options.out, "--pictures", std::to_string(options.pictures)};
  if (options.only) join.insert(join.end(), {"--only", std::to_string(*options.only)});
  join.push_back("--sources");
  join.insert(join.end(), options.merge.begin(), options.merge.end());
  const int code = python(join);
  if (code == kExitOk && !options.keep) fs::remove_all(options.out + "/runs");
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("ensonify dataset: labelled pictures by the thousand from a recipe of scenes.");
  app.name("ensonify dataset");
  Options options;
  declare(app, options);
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  try {
    return options.check.empty() ? make(options) : python({"check", options.check});
  } catch (const ExitError& error) {
    fmt::print(stderr, "{}\n", printable(error.what()));
    return error.code;
  } catch (const std::exception& error) {
    fmt::print(stderr, "ensonify dataset: {}\n", error.what());
    return kExitDied;
  }
}
