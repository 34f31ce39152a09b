#include "launch/file/exits.h"

#include <algorithm>
#include <csignal>
#include <cstring>

#include "components/errors/nearest_name.h"

namespace ensonify {
namespace {

/// By its name with or without SIG; 0 when there is none.
int signal_number(const std::string& name) {
  for (int number = 1; number < NSIG; ++number) {
    const char* known = ::sigabbrev_np(number);
    if (known != nullptr && (name == known || name == std::string("SIG") + known)) {
      return number;
    }
  }
  return 0;
}

void check_process(const ConfigReader& from, const std::string& name, const Launch& launch) {
  std::vector<std::string> names;
  for (const auto& process : launch.processes) {
    names.push_back(process.name);
  }
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    const std::string nearest = nearest_name(name, names);
    from.problem("process", "no process is named " + name + (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
  } else if (launch.processes[static_cast<std::size_t>(found - names.begin())].external) {
    from.problem("process", name + " is external: how it ends is known to whoever starts it");
  }
}

ExitExpectation read_exit(ConfigReader from, const Launch& launch) {
  ExitExpectation exit;
  from.required("process", exit.process);
  if (!exit.process.empty()) {
    check_process(from, exit.process, launch);
  }
  if (from.has("code") == from.has("signal")) {
    from.problem("", "needs one of code and signal");
  }
  from.optional("code", exit.code, 0, 255);
  std::string signal;
  from.optional("signal", signal);
  exit.signal = signal_number(signal);
  if (!signal.empty() && exit.signal == 0) {
    from.problem("signal", "\"" + signal + "\" is no signal; such as KILL, TERM or SEGV");
  }
  exit.name = exit.process + " ends with " + (exit.signal != 0 ? "signal " : "exit code ") +
              (exit.signal != 0 ? ::sigabbrev_np(exit.signal) : std::to_string(exit.code));
  return exit;
}

}  // namespace

std::vector<ConfigNode> read_exits(const ConfigReader& from, Launch& launch) {
  std::vector<ConfigNode> others;
  const auto& items = from.node("expect")->items;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i].is_map() || items[i].find("exit") == nullptr) {
      others.push_back(items[i]);
      continue;
    }
    ConfigReader entry = from.also({items[i], {}}, "expect[" + std::to_string(i) + "]");
    ExitExpectation exit = read_exit(entry.section("exit"), launch);
    entry.optional("name", exit.name);
    exit.given = items[i];
    launch.exits.push_back(std::move(exit));
  }
  return others;
}

}  // namespace ensonify
