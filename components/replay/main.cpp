#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "components/config/data_paths.h"
#include "components/errors/exit_code.h"
#include "components/errors/exit_error.h"
#include "components/replay/node.h"
#include "components/runtime/tool.h"
#include "launch/process/run.h"

namespace ensonify {
namespace {

int become(std::vector<std::string> words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  throw UserError(words[0] + ": cannot be started: " + std::strerror(errno));
}

/// Whether the program was started as a process of a run (it is given its launch and name) or typed by a user.
bool is_process_of_run(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--name" || word.starts_with("--name=") || word.starts_with("--parameters")) return true;
  }
  return false;
}

/// `ensonify replay FILE`: becomes `ensonify run launch/replay.yaml --arg record=FILE`. Returns only with an exit code.
int replay_verb(int argc, char** argv) {
  CLI::App app(
      "Feeds a record back: its messages are published again, each at its sim time, on topics replay/<recorded "
      "topic>.\n"
      "Short for `ensonify run launch/replay.yaml --arg record=FILE`; to feed a record to other processes, give your "
      "own\n"
      "launch file a process with `run: replay` (`ensonify describe replay`).",
      "ensonify replay");
  std::string file, out = "out/replay";
  std::vector<std::string> topics;
  double rate = 1.0;
  bool free = false;
  app.add_option("FILE", file, "a record (MCAP)")->required()->check(CLI::ExistingFile);
  app.add_option("--topic", topics, "publish these topics only: names or patterns such as bow/* (default: all)")
      ->allow_extra_args(false);
  CLI::Option* paced = app.add_option("--rate", rate, "sim seconds per second")->capture_default_str();
  app.add_flag("--free", free, "as fast as possible")->excludes(paced);
  app.add_option("--out", out, "folder of the run's log files")->capture_default_str();
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  return exit_code_of([&] {
    const std::string launch = find_data("launch/replay.yaml", {});
    if (launch.empty())
      throw UserError("launch/replay.yaml: not found in the data folders; is the installation whole?");
    std::vector<std::string> words = {
        program_folder() + "/ensonify-run", launch, "--arg", "record=" + file, "--out", out};
    if (free) words.push_back("--free");
    else words.insert(words.end(), {"--rate", CLI::detail::to_string(rate)});
    if (!topics.empty()) {
      std::string list;
      for (const std::string& topic : topics) list += (list.empty() ? "[\"" : ", \"") + topic + "\"";
      words.insert(words.end(), {"--set", "replay.topics=" + list + "]"});
    }
    return become(std::move(words));
  });
}

}  // namespace
}  // namespace ensonify

int main(int argc, char** argv) {
  if (!ensonify::is_process_of_run(argc, argv)) return ensonify::replay_verb(argc, argv);
  return ensonify::run<ensonify::ReplayNode>(argc, argv);
}
