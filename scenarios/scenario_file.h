#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "components/config/config_node.h"
#include "components/config/config_reader.h"
#include "components/config/parameters.h"
#include "components/config/parse_yaml.h"

namespace ensonify {

inline constexpr const char* kScenarioFormat = "scenario/1";

/// What a run has of its scenario without its world: the seed, and when it starts.
struct ScenarioHeader {
  std::uint64_t seed = 1;
  std::string start_utc = "2025-06-01T00:00:00Z";  // of sim time 0
  std::int64_t start_unix_ns = 1748736000000000000;
};

/// A scenario as a launch hands it to its processes: YAML, from which those who need it read the world.
struct ScenarioFile {
  std::string path;         // "": the launch names no scenario
  ConfigDocument document;  // with the launch's overrides applied
  std::string text;         // canonical, as it is recorded
  ScenarioHeader header;
  std::optional<std::int64_t> end_ns;  // of the launch, sim time
};

/// `seed` and `time` as a file has them.
struct TimeKeys {
  std::string start_utc = ScenarioHeader{}.start_utc;

  static void parameters(auto& self, auto&& visit) {
    visit("start_utc", "", any(), "UTC of sim time 0, such as 2025-06-01T12:00:00Z", self.start_utc);
  }
  void check(const ConfigReader& from) const;
};
struct HeaderKeys {
  std::uint64_t seed = ScenarioHeader{}.seed;
  TimeKeys time;

  static void parameters(auto& self, auto&& visit) {
    visit("seed", "", any(), "seed of everything random", self.seed);
    visit("time", "start of the run", self.time);
  }
  ScenarioHeader header() const;
};
/// Reads them.
void read_header(ConfigReader& from, ScenarioHeader& header);

/// A scenario's tree: the file's, over that of the scenario that it may name with `include`, and overrides over both. A
/// section in both files is merged key by key, a key in both has the including file's value. Where keys exclude each
/// other (sound_speed_mps, profile and cast; kinds of tide; a number or a grid of heights; plans of a mission) the one
/// given last replaces the others. Problems that leave a tree are in the document. Throws ConfigError.
ConfigDocument load_scenario(const std::string& path, const Overrides& overrides = {});
/// The same of a scenario that stands in another file.
ConfigDocument load_scenario(ConfigDocument document, const Overrides& overrides = {});

/// Nanoseconds since 1970-01-01 UTC of "2025-06-01T12:00:00Z" (fractions of a second allowed), or nothing.
std::optional<std::int64_t> parse_utc_ns(const std::string& text);

}  // namespace ensonify
