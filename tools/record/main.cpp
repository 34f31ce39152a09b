// ensonify record: records a live run from outside, and repairs records.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/record/repair.h"
#include "components/runtime/clock_client.h"
#include "components/runtime/tool.h"
#include "tools/record/live.h"

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

int print_live(const record_tool::LiveOptions& options, const record_tool::LiveRecord& live, bool json) {
  std::uint64_t received = 0;
  std::uint64_t missed = 0;
  nlohmann::ordered_json topics = nlohmann::ordered_json::object();
  for (const auto& [name, kept] : live.topics) {
    received += kept.received;
    missed += kept.missed;
    topics[name] = {{"received", kept.received}, {"missed", kept.missed}};
    if (kept.received == 0 && !json) fmt::print("{}: nothing came\n", name);
    if (kept.missed > 0 && !json) fmt::print("{}: {} messages, {} missed\n", name, kept.received, kept.missed);
  }
  if (json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"file", options.file},
                                              {"run_ended", live.run_ended},
                                              {"reset", live.reset},
                                              {"received", received},
                                              {"missed", missed},
                                              {"topics", topics}}
                           .dump(2));
  } else {
    fmt::print(
        "{}: {} messages on {} topics, {}; {}\n", options.file, received, live.topics.size(),
        missed == 0 ? std::string("none missed between a topic's first and last") : fmt::format("{} missed", missed),
        live.run_ended ? "the run has ended"
        : live.reset   ? "the run was reset, and goes on in another epoch"
                       : "the run goes on");
  }
  return missed == 0 ? kExitOk : kExitDataLost;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Records a live run from outside, and repairs records (MCAP files).", "ensonify record");
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
  record_tool::LiveOptions options;
  CLI::App* live = app.add_subcommand(
      "live",
      "Records a live run as an observer, which never slows it, from now on until the run ends, the time is over or\n"
      "Ctrl-C. What it could not take is counted by the messages' numbers, printed and kept in the record. What was\n"
      "published before the first or after the last message of a topic that came is not counted. A record with\n"
      "everything in it from the first message on is made by `ensonify run --record`.\n"
      "Exit code: 0 nothing was missed in between, 2 no such run or topic, 5 messages were missed or the disk is full, "
      "130 "
      "Ctrl-C.");
  live->add_option("FILE", options.file, "the record, an MCAP file")->required();
  live->add_option("TOPIC", options.topics, "topics, or patterns such as 'bow/*' (default: all)");
  add_run_option(*live, options.run);
  live->add_option("--timeout", options.timeout_s, "stop after so long, wall s (default: at the end of the run)")
      ->check(CLI::Range(1e-3, 1e6));
  live->add_flag("--json", json, "print what came and what was missed as JSON");
  return tool_main(app, argc, argv, [&]() -> int {
    if (live->parsed()) return print_live(options, record_tool::record_live(options), json);
    const record::Repair repair = record::repair(file);
    json ? print_json(file, repair) : print_text(file, repair);
    return kExitOk;
  });
}
