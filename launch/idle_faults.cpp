#include "launch/idle_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <utility>

namespace ensonify::launcher {
namespace {

const char* word_of(Injection::Kind kind) {
  switch (kind) {
    case Injection::Kind::kMute: return "mute";
    case Injection::Kind::kDrop: return "drop";
    case Injection::Kind::kDelay: return "delay";
    case Injection::Kind::kCorrupt: return "corrupt";
    case Injection::Kind::kKill: return "kill";
    case Injection::Kind::kPause: return "pause";
  }
  return "";
}

bool of_process(Injection::Kind kind) { return kind == Injection::Kind::kKill || kind == Injection::Kind::kPause; }

/// Lines of a log that say that such a fault acts.
std::size_t acts(const std::string& log, Injection::Kind kind, const std::string& target) {
  const std::string says = fmt::format(" inject {} ", word_of(kind));
  const std::string topic = " topic=" + target + (target.find('/') == std::string::npos ? "/" : " ");
  std::ifstream file(log);
  std::size_t count = 0;
  for (std::string line; std::getline(file, line);) {
    line += ' ';
    const bool found = line.find(says) != std::string::npos;
    count += std::size_t{found && (of_process(kind) || line.find(topic) != std::string::npos)};
  }
  return count;
}

}  // namespace

std::vector<Expectation> idle_faults(const Launch& launch, const std::string& out, double sim_s) {
  std::map<std::pair<Injection::Kind, std::string>, std::size_t> seen;  // of a kind and a target, so far
  std::vector<Expectation> idle;
  for (std::size_t i = 0; i < launch.injections.size(); ++i) {
    const Injection& one = launch.injections[i];
    const std::string process = one.target.substr(0, one.target.find('/'));
    const auto spec = std::ranges::find(launch.processes, process, &ProcessSpec::name);
    if (spec == launch.processes.end() || spec->external) continue;
    const std::size_t wanted = ++seen[{one.kind, one.target}];
    if (acts(out + "/log/" + process + ".log", one.kind, one.target) >= wanted) continue;
    idle.push_back(
        {fmt::format("inject[{}] acts", i), false, sim_s,
         fmt::format("{}: {} of {} did nothing: its time did not come while there was something to do it to, or "
                     "{} does not know inject",
                     one.place, word_of(one.kind), one.target, process)});
  }
  return idle;
}

}  // namespace ensonify::launcher
