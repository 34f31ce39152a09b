#include "launch/hosted.h"

#include <algorithm>

#include "launch/hosted_components.h"

namespace ensonify::launcher {
namespace {

bool ends_by_itself(const Launch& launch, const std::string& name) {
  const auto is_it = [&](const Injection& injection) {
    const bool of_process = injection.kind == Injection::Kind::kKill || injection.kind == Injection::Kind::kPause;
    return of_process && injection.target == name;
  };
  return std::ranges::any_of(launch.injections, is_it) ||
         std::ranges::any_of(launch.exits, [&](const ExitExpectation& exit) { return exit.process == name; });
}

}  // namespace

std::set<std::string> hosted_processes(const Launch& launch) {
  std::set<std::string> names;
  for (const ProcessSpec& p : launch.processes) {
    const bool can_be = std::ranges::find(kHostedComponents, p.component) != std::end(kHostedComponents);
    const bool has_its_own = p.external || p.observer || p.may_be_lost || p.memory_mb || !p.cpus.empty() ||
                             !p.env.empty() || ends_by_itself(launch, p.name);
    if (can_be && !has_its_own) names.insert(p.name);
  }
  return names;
}

}  // namespace ensonify::launcher
