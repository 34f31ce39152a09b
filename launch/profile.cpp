#include "launch/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "launch/process/profiled_node.h"
#include "launch/report.h"

namespace ensonify::launcher {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::vector<Json> written_in(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<Json> profiles;
  for (const fs::path& file : files) {
    std::ifstream stream(file);
    Json profile = Json::parse(stream, nullptr, false);
    if (profile.is_object()) profiles.push_back(std::move(profile));
  }
  return profiles;
}

std::string row(const std::string& name, double count, double wall_s, double processor_s, double of_s,
                double items = 0.0) {
  const auto each = [count](double s) { return count > 0.0 ? 1e3 * s / count : 0.0; };
  const std::string of_items =
      items > 0.0 ? fmt::format("{:>12.0f}{:>10.0f}", items / count, 1e9 * processor_s / items) : std::string();
  return fmt::format("  {:<18}{:>9.0f}{:>14.3f}{:>19.3f}{:>8.1f} %{}\n", name, count, each(wall_s), each(processor_s),
                     of_s > 0.0 ? 100.0 * processor_s / of_s : 0.0, of_items);
}

/// Stages of one process. The rest of a step is what no stage has.
std::string table_of(const Json& profile) {
  const double wall_s = profile["wall_s"], processor_s = profile["processor_s"];
  std::string text = fmt::format("{}: {:.2f} s, {:.2f} s of processor time\n", profile["process"].get<std::string>(),
                                 wall_s, processor_s);
  const Json& stages = profile["stages"];
  if (!stages.contains("step")) return text;
  const Json& step = stages["step"];
  double rest_s = step["wall_s"], rest_processor_s = step["processor_s"];
  for (const auto& [name, stage] : stages.items()) {
    if (name == "step") continue;
    const bool part = stage["part_of_beamform"];
    text += row(part ? "  of it " + name : name, stage["count"], stage["wall_s"], stage["processor_s"], processor_s,
                stage["items"]);
    if (part) continue;
    rest_s -= stage["wall_s"].get<double>();
    rest_processor_s -= stage["processor_s"].get<double>();
  }
  text += row("rest of steps", step["count"], rest_s, rest_processor_s, processor_s);
  text += row("waiting", step["count"], wall_s - step["wall_s"].get<double>(),
              processor_s - step["processor_s"].get<double>(), processor_s);
  if (const auto left_out = profile["events_left_out"].get<std::size_t>(); left_out > 0)
    text += fmt::format("  the trace file lacks its last {} events\n", left_out);
  return text;
}

}  // namespace

Profiles gather_profiles(const std::string& out) {
  Json of_processes = Json::object(), events = Json::array();
  Profiles profiles;
  for (Json& profile : written_in(profile_folder(out))) {
    profiles.table += table_of(profile);
    for (Json& event : profile["traceEvents"]) events.push_back(std::move(event));
    const std::string process = profile["process"];
    profile.erase("traceEvents");
    profile.erase("process");
    of_processes[process] = std::move(profile);
  }
  if (!profiles.table.empty())
    profiles.table.insert(0, fmt::format("  {:<18}{:>9}{:>14}{:>19}{:>10}{:>12}{:>10}\n", "stage", "count",
                                         "wall ms each", "processor ms each", "share", "items each", "ns each"));
  write_text(out + "/profile.json", Json{{"traceEvents", std::move(events)}, {"displayTimeUnit", "ms"}}.dump() + "\n");
  profiles.json = of_processes.dump();
  return profiles;
}

}  // namespace ensonify::launcher
