// ensonify info: what a record of another program's format holds, and what is wrong with it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/errors/printable.h"
#include "components/runtime/tool.h"
#include "tools/info/print.h"
#include "tools/info/summarise.h"

using namespace ensonify;

namespace {

constexpr int kFaultsFound = 1;

/// What is wrong with the file as a whole has its name before it, once.
std::string with_name(const std::string& file, const std::string& cause) {
  return cause.starts_with(file + ": ") ? cause : file + ": " + cause;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Says what files of records hold: datagrams, times, positions, depths, pings that are missing, mountings, and\n"
      "faults with their place. Formats, recognised by content: Kongsberg .all and .kmall (.wcd, .kmwcd), Triton XTF.\n"
      "Exit code: 0 no fault, 1 faults found, 2 a file cannot be read at all.",
      "ensonify info");
  std::vector<std::string> files;
  bool json = false;
  app.add_option("FILE", files, "records; of any size, read once from front to back")->required();
  app.add_flag("--json", json, "print a list with one object a file");
  return tool_main(app, argc, argv, [&]() -> int {
    int code = kExitOk;
    auto list = nlohmann::ordered_json::array();
    for (const std::string& file : files) {
      try {
        formats::Window window(file);
        const info::Summary summary = info::summarise(window);
        if (interrupted()) return kExitInterrupted;  // what was read so far is not the file
        if (json) list.push_back(info::json_of(file, summary));
        else fmt::print("{}\n", info::text_of(file, summary));
        if (summary.faults.count() > 0) code = std::max(code, kFaultsFound);
      } catch (const UserError& error) {
        code = kExitUserError;
        fmt::print(stderr, "{}\n", with_name(file, error.what()));
        if (json) list.push_back({{"file", printable(file)}, {"error", printable(with_name(file, error.what()))}});
      }
    }
    if (json) fmt::print("{}\n", list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return code;
  });
}
