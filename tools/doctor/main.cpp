// ensonify doctor: searches for what commonly goes wrong.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "tools/doctor/installation.h"
#include "tools/doctor/machine.h"
#include "tools/doctor/runs.h"

namespace {

using namespace ensonify;
using namespace ensonify::doctor;

void print_text(const Findings& findings) {
  std::size_t width = 0;
  for (const Finding& f : findings) width = std::max(width, f.check.size());
  for (const Finding& f : findings) {
    fmt::print("{:<4}  {:<{}}  {}\n", word_of(f.level), f.check, width, f.text);
    if (!f.advice.empty()) fmt::print("{:{}}{}\n", "", width + 8, f.advice);
  }
}

void print_json(const Findings& findings, bool ok) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Finding& f : findings) {
    all.push_back({{"check", f.check}, {"level", word_of(f.level)}, {"text", f.text}, {"advice", f.advice}});
  }
  fmt::print("{}\n", nlohmann::ordered_json{{"ok", ok}, {"findings", all}}.dump());
}

int examine(const std::string& out, bool json) {
  Findings findings = check_machine(out);
  for (const Findings& more : {check_runs(), check_installation()}) {
    findings.insert(findings.end(), more.begin(), more.end());
  }
  const bool ok = std::none_of(findings.begin(), findings.end(), [](const auto& f) { return f.level == Level::kFail; });
  if (json) print_json(findings, ok);
  else print_text(findings);
  return ok ? kExitOk : kExitUserError;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Checks this machine and installation for what commonly goes wrong, and says what to do about it.\n"
      "Exit code: 0 nothing fails (there may be warnings), 2 something does.",
      "ensonify doctor");
  std::string out = ".";
  bool json = false;
  app.add_option("--out", out, "existing folder where results will go: is there room, may we write?")
      ->capture_default_str();
  app.add_flag("--json", json, "print the findings as JSON");
  return tool_main(app, argc, argv, [&] { return examine(out, json); });
}
