#include "launch/check_ports.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "components/runtime/declared.h"
#include "components/runtime/protocol.h"
#include "launch/child.h"
#include "launch/process/launch_wiring.h"
#include "messages/declarations.h"

namespace ensonify::launcher {
namespace {

constexpr std::chrono::seconds kPatience{10};
constexpr int kAllLines = 100000;

/// A folder for what the programs say, removed at the end.
struct ScratchFolder {
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "ensonify-check-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw UserError(name + ": cannot be made");
    }
    path = name;
  }
  ~ScratchFolder() {
    std::error_code error;
    std::filesystem::remove_all(path, error);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string path;
};

struct Answer {
  std::optional<Ending> ending;  // nothing: it was killed
  std::string out;
  std::string error;

  bool ended_with(int code) const { return ending && ending->signal == 0 && ending->exit_code == code; }
};

Answer ask(Command command, const std::string& folder, Signals& signals) {
  command.log_file = folder + "/out";
  command.error_file = folder + "/error";
  Child child(command);
  const auto ending = end_within(child, signals, kPatience);
  return {ending, tail(command.log_file, kAllLines), tail(command.error_file, kAllLines)};
}

/// Adds what one program said; false when it was no declaration.
bool add_declaration(const std::string& text, const std::string& name, CheckedPorts& checked) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) {
    return false;
  }
  try {
    checked.declarations.push_back(protocol::read_declaration(text));
    checked.declarations.back().process = name;
    return true;
  } catch (const std::exception& error) {
    checked.problems.push_back(name + ": --check printed ports that cannot be read: " + error.what());
    return true;
  }
}

}  // namespace

CheckedPorts check_ports(const Launch& launch, const RunPlaces& places) {
  CheckedPorts checked;
  const ScratchFolder folder;
  Signals signals;
  for (const auto& process : launch.processes) {
    if (process.observer) {
      continue;
    }
    if (process.external) {
      checked.unknown.push_back(process.name);
      continue;
    }
    try {
      Command command = process_command(launch, process, places, "");
      command.argv.emplace_back("--check");
      const Answer answer = ask(std::move(command), folder.path, signals);
      const bool native = process.argv.empty();
      if (answer.ended_with(kExitOk) && add_declaration(answer.out, process.name, checked)) {
        continue;
      }
      if (native || answer.ended_with(kExitUserError)) {
        const std::string stated = answer.error.empty() ? answer.out : answer.error;
        checked.problems.push_back(stated.empty() ? process.name + ": --check failed without a word" : stated);
      } else {
        checked.unknown.push_back(process.name);
      }
    } catch (const UserError& error) {
      checked.problems.emplace_back(error.what());
    }
  }
  return checked;
}

std::vector<std::string> unpaged_mission_problems(const Launch& launch, const RunPlaces& places) {
  const auto runs = [&](const char* component) {
    return std::any_of(launch.processes.begin(), launch.processes.end(),
                       [&](const ProcessSpec& process) { return process.component == component; });
  };
  if (launch.scenario.path.empty() || !runs("autopilot") || runs("terrain_pager")) return {};
  Command command;
  command.argv = {places.program_folder + "/ensonify-terrain_pager", "--check-mission"};
  const auto arguments = to_arguments(launch.options);
  command.argv.insert(command.argv.end(), arguments.begin(), arguments.end());
  const ScratchFolder folder;
  Signals signals;
  const Answer answer = ask(std::move(command), folder.path, signals);
  if (!answer.ended_with(kExitUserError)) return {};
  return {answer.error};
}

std::vector<std::string> wiring_problems(const Launch& launch, const CheckedPorts& checked) {
  if (!checked.unknown.empty() || !checked.problems.empty()) {
    return {};
  }
  return wire(checked.declarations, wire_rules(launch), process_places(launch)).problems;
}

std::vector<std::string> setting_problems(const Mission& mission, const CheckedPorts& checked) {
  const bool steered = std::ranges::any_of(checked.declarations,
                                           [](const Declaration& process) { return process.component == "autopilot"; });
  std::vector<std::string> problems;
  if (!steered) return problems;
  const auto heads = declared<msg::HeadDeclaration>(declarations_json(checked.declarations));
  for (const ConfigProblem& problem : ensonify::setting_problems(mission, heads)) problems.push_back(problem.text());
  return problems;
}

std::vector<std::string> resolution_warnings(const CheckedPorts& checked) {
  const std::string declarations = declarations_json(checked.declarations);
  std::vector<std::string> warnings;
  for (const auto& [pager, seabed] : declared<msg::PagerDeclaration>(declarations)) {
    for (const auto& [name, head] : declared<msg::HeadDeclaration>(declarations)) {
      const double footprint_m = seabed.shallowest_m * head.finest_beam_rad;
      if (seabed.post_spacing_m > 0.0 && footprint_m > 0.0 && seabed.post_spacing_m > footprint_m) {
        warnings.push_back(fmt::format(
            "{}: posts are {:.3g} m apart, but {} resolves {:.2g} m at {:.3g} m depth; details will be missing", pager,
            seabed.post_spacing_m, name, footprint_m, seabed.shallowest_m));
      }
    }
  }
  return warnings;
}

}  // namespace ensonify::launcher
