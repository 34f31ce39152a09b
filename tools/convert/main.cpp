// ensonify convert: a record as hydrographic software reads it.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"
#include "components/record/record_path.h"
#include "components/runtime/tool.h"
#include "launch/file/launch_file.h"
#include "tools/convert/recorded_run.h"
#include "tools/convert/replay_launch.h"

namespace {

using namespace ensonify;
namespace fs = std::filesystem;

struct Options {
  std::string record, folder = ".";
  std::vector<std::string> formats, sets;
  convert::Wanted wanted;
};

/// A folder within another, gone at the end; so is the other where it was made for this and stays empty.
class Workshop {
 public:
  explicit Workshop(const fs::path& within) {
    std::error_code error;
    made_ = fs::create_directories(within, error);
    std::string path = (within / ".convert-XXXXXX").string();
    if (error || ::mkdtemp(path.data()) == nullptr) throw UserError(within.string() + ": no file can be made there");
    path_ = path;
  }
  ~Workshop() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    if (made_) fs::remove(path_.parent_path(), ignored);  // unless it holds files now
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  bool made_ = false;
};

void write(const fs::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  if (!stream.flush()) throw DataLost(file.string() + ": cannot be written");
}

/// Moves all files there and names them.
std::vector<std::string> moved(const fs::path& from, const fs::path& to) {
  std::vector<std::string> names;
  if (!fs::is_directory(from)) return names;
  for (const auto& entry : fs::directory_iterator(from)) {
    fs::rename(entry.path(), to / entry.path().filename());
    names.push_back((to / entry.path().filename()).lexically_normal().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Runs the launch as `ensonify run --in-process` does; its exit code. What it says goes to our standard error.
int run_in_one_process(const LaunchOptions& launch) {
  std::vector<std::string> words = to_arguments(launch);
  words.insert(words.begin(), program_folder() + "/ensonify-local");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  if (const int error = ::posix_spawn(&child, argv.front(), nullptr, nullptr, argv.data(), environ); error != 0)
    throw UserError(words.front() + ": cannot be run: " + std::strerror(error));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    if (interrupted()) ::kill(child, SIGINT);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : kExitDied;
}

/// Whether one of these formats is wanted.
bool to(const Options& options, std::initializer_list<const char*> some) {
  return std::find_first_of(options.formats.begin(), options.formats.end(), some.begin(), some.end()) !=
         options.formats.end();
}

/// A UserError names what a logger of this head reads and the record does not hold.
void check_held(const convert::RecordedRun& recorded, const std::string& head, const Options& options) {
  const auto demand = [&](bool held, const std::string& what, const std::string& topics) {
    if (!held)
      throw UserError(fmt::format("{}: holds no {}, which a logger reads; record {} for --to {}", recorded.file, what,
                                  topics, fmt::join(options.formats, ",")));
  };
  const auto holds = [&](const std::string& type) {
    return std::any_of(recorded.topics.begin(), recorded.topics.end(),
                       [&](const auto& one) { return one.second == type; });
  };
  for (const char* type : {"estimate/1", "attitude/1", "position/1"}) demand(holds(type), type, "nav/*");
  if (!to(options, {"wcd", "kmwcd"})) return;
  if (head.empty()) demand(holds("ping/1"), "ping/1", "the head's ping");
  else demand(recorded.has(head + "/ping"), "ping/1 of " + head, head + "/ping");
}

int run(const Options& options) {
  const convert::RecordedRun recorded =
      convert::recorded_run(fs::absolute(record::record_path(options.record)).string());
  if (interrupted()) return kExitInterrupted;
  convert::Wanted wanted = options.wanted;
  wanted.sidescan = to(options, {"xtf"});
  const convert::ReplayLaunch replay = convert::replay_launch(recorded, wanted, "scenario.yaml", "files");
  check_held(recorded, replay.head, options);
  const Workshop workshop(options.folder);
  const fs::path files = workshop.path() / "files";
  write(workshop.path() / "scenario.yaml", recorded.scenario);
  write(workshop.path() / "launch.yaml", replay.text);
  LaunchOptions launch{.file = (workshop.path() / "launch.yaml").string(), .out = workshop.path().string()};
  launch.sets.push_back(fmt::format("{}.formats=[{}]", replay.logger, fmt::join(options.formats, ", ")));
  for (const std::string& set : options.sets) launch.sets.push_back(replay.logger + "." + set);
  const int code = run_in_one_process(launch);
  if (code == kExitDataLost) moved(files, options.folder);  // what arrived ends with a whole datagram
  if (code != kExitOk) return code;
  const auto names = moved(files, options.folder);
  if (names.empty()) throw UserError(recorded.file + ": makes no file: no ping has a second of navigation before it");
  fmt::print("{}\n", fmt::join(names, "\n"));
  for (const std::string& head : recorded.heads()) {
    if (to(options, {"all", "kmall"}) && !recorded.has(head + "/seabed_image"))
      fmt::print(stderr, "{}: holds no seabed image of {}: one sample a beam is written, its sounding's strength\n",
                 recorded.file, head);
    if (to(options, {"wcd", "kmwcd"}) && !recorded.has(head + "/ping"))
      fmt::print(stderr, "{}: holds no ping/1 of {}: there is no water column in its files\n", recorded.file, head);
  }
  if (!recorded.truncated.empty()) fmt::print(stderr, "{}: ends early {}\n", recorded.file, recorded.truncated);
  return kExitOk;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Writes a record as hydrographic software reads it, as the component logger does live: the same bytes, from a\n"
      "record that holds what a logger reads (soundings, seabed image, estimate, attitude, position).\n"
      "Exit code: 0 done, 2 wrong input, 5 the disk is full: what is there ends with a whole datagram, 130 "
      "interrupted.",
      "ensonify convert");
  Options options;
  app.add_option("RECORD", options.record, "a record, or a run's folder with one")->required();
  app.add_option("DIR", options.folder, "folder of the files; it is made")->capture_default_str();
  app.add_option("--to", options.formats, "formats, with commas between: those of the component logger")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--head", options.wanted.head, "head whose soundings are written (default: that of the run's logger)");
  app.add_option("--logger", options.wanted.logger,
                 "logger of the recorded run whose parameters hold (default: its only one, or else the defaults)");
  app.add_option("--set", options.sets, "KEY=VALUE, a parameter of the logger; may be given again")
      ->allow_extra_args(false)
      ->check([](const std::string& set) -> std::string {
        const auto end = set.find('=');
        if (end == std::string::npos) return set + ": is not KEY=VALUE";
        const std::string key = set.substr(0, end);
        if (key == "formats") return "formats: is given by --to";
        if (key == "folder") return "folder: is given as DIR";
        return {};
      });
  return tool_main(app, argc, argv, [&] { return run(options); });
}
