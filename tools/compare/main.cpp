#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "components/errors/exit_code.h"
#include "components/errors/exit_error.h"
#include "components/record/compare.h"
#include "components/runtime/tool.h"
#include "launch/process/run.h"

namespace {

using namespace ensonify;
using record::Comparison;

std::string first_in_words(const record::Difference& d) {
  const std::string place = fmt::format("t={:.9f} s {} seq {}", seconds(d.t_sim), d.topic, d.seq);
  if (d.field.empty()) return fmt::format("{}: the message is {} in A, {} in B", place, d.a, d.b);
  return fmt::format("{}: {} is {} in A, {} in B", place, d.field, d.a, d.b);
}

void print_text(const Comparison& comparison) {
  std::uint64_t messages = 0;
  std::size_t width = 5;
  for (const auto& topic : comparison.topics) {
    messages += topic.a;
    width = std::max(width, topic.topic.size());
  }
  if (comparison.first) {
    fmt::print("differ: {}\n", first_in_words(*comparison.first));
    fmt::print("{:<{}} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "topic", width, "A", "B", "only A", "only B",
               "differing");
    for (const auto& t : comparison.topics) {
      fmt::print("{:<{}} {:>10} {:>10} {:>10} {:>10} {:>10}\n", t.topic, width, t.a, t.b, t.only_a, t.only_b,
                 t.differing);
    }
  } else {
    fmt::print("same: {} messages on {} topics\n", messages, comparison.topics.size());
  }
  for (const std::string& note : comparison.notes) fmt::print("note: {}\n", note);
}

void print_json(const Comparison& comparison) {
  nlohmann::ordered_json json;
  json["same"] = !comparison.first;
  if (const auto& d = comparison.first) {
    json["first"] = {{"t_sim_ns", d->t_sim.count()},
                     {"topic", d->topic},
                     {"seq", d->seq},
                     {"field", d->field},
                     {"a", d->a},
                     {"b", d->b}};
  }
  json["topics"] = nlohmann::ordered_json::array();
  for (const auto& t : comparison.topics) {
    json["topics"].push_back({{"topic", t.topic},
                              {"a", t.a},
                              {"b", t.b},
                              {"only_a", t.only_a},
                              {"only_b", t.only_b},
                              {"differing", t.differing}});
  }
  json["notes"] = comparison.notes;
  fmt::print("{}\n", json.dump(2));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Compares two records message by message and names the first difference in sim time.\n"
      "Exit code: 0 the same messages, 6 they differ, 2 a record cannot be read.",
      "ensonify compare");
  std::string file_a, file_b;
  std::vector<std::string> topics;
  bool json = false;
  app.add_option("A", file_a, "a record")->required();
  app.add_option("B", file_b, "another record")->required();
  app.add_option("--topic", topics, "compare these topics only: names or patterns such as bow/* (default: all)")
      ->allow_extra_args(false);
  app.add_flag("--json", json, "print the result as JSON; times in ns of sim time");
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  return exit_code_of([&] {
    record::RecordReader a(file_a);
    record::RecordReader b(file_b);
    const Comparison comparison = record::compare(a, b, topics);
    json ? print_json(comparison) : print_text(comparison);
    return comparison.first ? kExitDiffer : kExitOk;
  });
}
