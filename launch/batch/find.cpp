#include "launch/batch/find.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "components/config/config_error.h"
#include "components/config/parse_yaml.h"
#include "components/errors/exit_error.h"
#include "launch/file/tree.h"
#include "scenarios/world/world.h"

namespace ensonify::batch {
namespace {

namespace fs = std::filesystem;

/// Says what it is in a line of its own, as every launch file does.
bool is_launch_file(const std::string& file) {
  const std::string extension = fs::path(file).extension().string();
  if (extension != ".yaml" && extension != ".yml") return false;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("ensonify:")) return line.find("launch/") != std::string::npos;
  }
  return false;
}

std::vector<std::string> files_below(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with(".")) at.disable_recursion_pending();
    else if (at->is_regular_file() && is_launch_file(at->path().string())) files.push_back(at->path().string());
  }
  if (error) throw UserError(folder + ": cannot be read: " + error.message());
  std::ranges::sort(files);
  return files;
}

std::string name_of(const std::string& assignment) { return assignment.substr(0, assignment.find('=')); }

/// Those of the given arguments that a launch file has.
std::vector<std::string> args_of(const ConfigNode& root, const std::vector<std::string>& given,
                                 std::set<std::string>& used) {
  std::vector<std::string> own;
  const ConfigNode* args = root.find("args");
  for (const std::string& one : given) {
    if (args == nullptr || args->find(name_of(one)) == nullptr) continue;
    own.push_back(one);
    used.insert(name_of(one));
  }
  return own;
}

bool has_expectations(const Launch& launch) {
  return !launch.exits.empty() ||
         std::ranges::any_of(launch.processes, [](const ProcessSpec& one) { return one.component == "expect"; });
}

/// The problem that says which argument is missing, as a reason; "": none is.
std::string missing_argument(const ConfigError& error) {
  for (const ConfigProblem& problem : error.problems()) {
    if (problem.message.starts_with("must be given; use --arg"))
      return "needs " + problem.message.substr(problem.message.find("--arg"));
  }
  return "";
}

/// Reads it. `direct`: it was named itself. Nothing where it holds no expectation.
std::optional<Found> read(const std::string& file, const FindOptions& options, bool direct,
                          const std::string& program_folder, std::set<std::string>& used) {
  Found found{.file = file};
  found.job.label = file;
  found.job.options.file = file;
  found.job.options.sets = options.sets;
  bool may_expect = true;
  try {
    const ConfigNode root = parse_config_file(file).root;
    may_expect = direct || root.find("expect") != nullptr || root.find("include") != nullptr;
    found.job.options.args = args_of(root, options.args, used);
    if (const ConfigNode* args = root.find("args")) {
      for (const auto& entry : args->entries) found.args.push_back(entry.key);
    }
    const Launch launch = read_launch(
        found.job.options, [](ConfigReader& from, const std::string& scenario) { read_world(from, scenario); });
    if (!has_expectations(launch)) {
      if (!direct) return std::nullopt;
      throw UserError(file + ": has no `expect:`, so there is nothing to test; allowed: a launch file that has");
    }
    for (const ProcessSpec& process : launch.processes) {
      if (process.external) found.skipped = "waits for " + process.name + ", which somebody else starts";
    }
    found.job.id = id_of(launch, program_folder);
    found.job.programs = programs_of(launch, program_folder);
  } catch (const ConfigError& error) {
    if (!may_expect) return std::nullopt;  // a part that others include
    found.skipped = missing_argument(error);
    if (found.skipped.empty()) found.fault = error.what();
  }
  return found;
}

}  // namespace

std::vector<Found> find_launches(const std::vector<std::string>& paths, const FindOptions& options,
                                 const std::string& program_folder) {
  std::vector<Found> all;
  std::set<std::string> seen, used;
  const auto add = [&](const std::string& file, bool direct) {
    if (file.find(options.text) == std::string::npos || !seen.insert(fs::weakly_canonical(file).string()).second)
      return;
    if (auto found = read(file, options, direct, program_folder, used)) all.push_back(std::move(*found));
  };
  for (const std::string& path : paths) {
    if (fs::is_directory(path)) {
      for (const std::string& file : files_below(path)) add(file, false);
    } else if (fs::is_regular_file(path)) {
      add(path, true);
    } else {
      throw UserError(path + ": does not exist; allowed: launch files, and folders that hold some");
    }
  }
  if (all.empty())
    throw UserError(fmt::format("no launch file with `expect:` {}in {}",
                                options.text.empty() ? "" : "whose path holds \"" + options.text + "\" ",
                                fmt::join(paths, ", ")));
  for (const std::string& one : options.args) {
    if (!used.contains(name_of(one)))
      throw UserError("--arg " + one + ": no launch file has an argument " + name_of(one));
  }
  return all;
}

}  // namespace ensonify::batch
