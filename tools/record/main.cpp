// ensonify record: what can be done with a record besides replaying and comparing it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/record/repair.h"
#include "components/runtime/tool.h"

namespace {

using namespace ensonify;

void print_text(const std::string& file, const record::Repair& repair) {
  const std::string holds = repair.last
                                ? fmt::format("{} messages to t={:.3f} s", repair.messages, seconds(*repair.last))
                                : std::string("no message");
  if (repair.was_whole) {
    fmt::print("{}: is whole, with {}; nothing was changed\n", file, holds);
  } else {
    fmt::print("{}: repaired, with {}; {} bytes kept, {} bytes behind the last whole chunk dropped\n", file, holds,
               repair.kept_bytes, repair.dropped_bytes);
  }
}

void print_json(const std::string& file, const record::Repair& repair) {
  nlohmann::ordered_json json{
      {"file", file},       {"was_whole", repair.was_whole},   {"messages", repair.messages},
      {"last_ns", nullptr}, {"kept_bytes", repair.kept_bytes}, {"dropped_bytes", repair.dropped_bytes}};
  if (repair.last) json["last_ns"] = repair.last->count();
  fmt::print("{}\n", json.dump(2));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Works on records (MCAP files that the recorder wrote).", "ensonify record");
  app.require_subcommand(1);
  std::string file;
  bool json = false;
  CLI::App* mend = app.add_subcommand(
      "repair",
      "Gives a record whose writer was killed, or whose disk was full, the index and footer that readers ask for.\n"
      "In place: all that stands to its last whole chunk (a second of sim time, 16 MiB) keeps its bytes.\n"
      "Exit code: 0 the record is whole now, 2 it is no record, is damaged before its end or is being written,\n"
      "5 there is no room for the index.");
  mend->add_option("FILE", file, "a record")->required();
  mend->add_flag("--json", json, "print the result as JSON; times in ns of sim time");
  return tool_main(app, argc, argv, [&] {
    const record::Repair repair = record::repair(file);
    json ? print_json(file, repair) : print_text(file, repair);
    return kExitOk;
  });
}
