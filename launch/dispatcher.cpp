// ensonify: executes ensonify-X found beside itself.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "components/config/config_error.h"
#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"
#include "components/errors/nearest_name.h"
#include "components/runtime/version.h"

namespace {

namespace fs = std::filesystem;
using namespace ensonify;

const std::string kPrefix = "ensonify-";

/// Verbs are the programs beside this one; the processes of a run are programs too, but nobody types them.
struct Programs {
  std::vector<std::string> verbs;
  std::vector<std::string> processes;
};

const std::vector<std::pair<std::string, std::string>> kKnownVerbs = {
    {"run", "start the processes of a launch file and watch over them"},
    {"test", "run launch files as tests, several at once: a table, JUnit"},
    {"dataset", "labelled pictures by the thousand from a recipe of scenes"},
    {"detectability", "how well a detector finds what is in a recipe's pictures, and what that depends on"},
    {"check", "check a launch file, its configurations and its wiring without running it"},
    {"topic", "list, info, echo, hz and bw of the topics of a live run; pub publishes on one"},
    {"graph", "draw who talks to whom"},
    {"console", "watch a run or a record in a browser"},
    {"clock", "list of live runs; status, pause, resume, step and rate of one"},
    {"replay", "feed a record back"},
    {"record", "record a live run from outside; repair a record whose writer was killed"},
    {"compare", "say where two records differ"},
    {"convert", "a record as hydrographic software reads it (.all, .kmall, XTF)"},
    {"info", "what records of other formats hold (.all, .kmall, XTF), and what is wrong with them"},
    {"georeference", "the soundings of a multibeam's file, placed anew from what was measured"},
    {"describe", "a component's parameters, ports and messages"},
    {"physics", "values of the acoustic models, as CSV or JSON"},
    {"plan", "surveys before they are run: lines, speed, sidescan, import"},
    {"terrain", "seabeds on disk: build, info, verify, sample"},
    {"doctor", "check this machine and installation"},
    {"feed", "doctor: what a navigation feed sends, and the source to use for it"},
    {"grid", "the depths of a survey on a grid: GeoTIFF, BAG"},
    {"patch", "the patch test of a multibeam, from a record of its lines"},
    {"plot", "pictures and summary of a survey"},
};

Programs programs_in(const std::string& folder) {
  Programs programs;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kPrefix) || ::access(entry.path().c_str(), X_OK) != 0) {
      continue;
    }
    const std::string verb = name.substr(kPrefix.size());
    const bool known =
        std::any_of(kKnownVerbs.begin(), kKnownVerbs.end(), [&](const auto& v) { return v.first == verb; });
    if (known) {
      programs.verbs.push_back(verb);
    } else if (verb != "conductor" && verb != "local") {  // which `ensonify run` starts by itself
      programs.processes.push_back(verb);
    }
  }
  std::sort(programs.processes.begin(), programs.processes.end());
  return programs;
}

void print_usage(const Programs& programs, std::FILE* to) {
  fmt::print(to, "Usage: ensonify VERB [OPTIONS]      (ensonify VERB --help says more)\n\n");
  for (const auto& [verb, what] : kKnownVerbs) {
    if (std::find(programs.verbs.begin(), programs.verbs.end(), verb) != programs.verbs.end()) {
      fmt::print(to, "  {:<14} {}\n", verb, what);
    }
  }
  if (!programs.processes.empty()) {
    fmt::print(to, "\nProcesses of a launch file: {}\n", fmt::join(programs.processes, ", "));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string folder = program_folder();
  const Programs programs = programs_in(folder);
  const std::string verb = argc > 1 ? argv[1] : "";
  if (verb == "--help" || verb == "-h" || verb == "help") {
    print_usage(programs, stdout);
    return kExitOk;
  }
  if (verb == "--version") {
    fmt::print("ensonify {}\n", kVersion);
    return kExitOk;
  }
  if (verb.empty()) {
    print_usage(programs, stderr);
    return kExitUserError;
  }
  const std::string program = folder + "/" + kPrefix + verb;
  if (verb.find('/') == std::string::npos) {
    argv[1] = const_cast<char*>(program.c_str());
    ::execv(program.c_str(), argv + 1);
  }
  const bool known =
      std::any_of(kKnownVerbs.begin(), kKnownVerbs.end(), [&](const auto& v) { return v.first == verb; });
  if (known) {  // a build of some programs only, as that of the demo
    fmt::print(stderr, "ensonify: {} is not built here: {} is missing; `./dev build` makes every program\n", verb,
               program);
    return kExitUserError;
  }
  std::vector<std::string> all = programs.verbs;
  all.insert(all.end(), programs.processes.begin(), programs.processes.end());
  const std::string nearest = nearest_name(verb, all);
  fmt::print(stderr, "ensonify: there is no {}{}\n\n", verb, nearest.empty() ? "" : "; did you mean " + nearest + "?");
  print_usage(programs, stderr);
  return kExitUserError;
}
