#include "scenarios/scenario_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "components/config/data_paths.h"
#include "components/config/parse_yaml.h"
#include "components/config/read_parameters.h"

namespace ensonify {

namespace {

/// Keys of a section of which one is given, or those of one line together.
struct Alternatives {
  std::vector<std::string> sections;
  std::vector<std::vector<std::string>> keys;
};

const std::array<Alternatives, 5>& alternatives() {
  static const std::array<Alternatives, 5> all = {
      {{{"water", "water.applied"}, {{"sound_speed_mps"}, {"profile"}, {"cast"}}},
       {{"vertical.tide"}, {{"constant_m"}, {"mean_m", "constituents"}, {"gauge"}}},
       {{"vertical"}, {{"geoid_above_ellipsoid_m"}, {"geoid_above_ellipsoid_grid"}}},
       {{"vertical"}, {{"datum_above_geoid_m"}, {"datum_above_geoid_grid"}}},
       {{"mission"}, {{"runlines"}, {"lawnmower"}, {"auto"}, {"adaptive"}, {"steps"}, {"file"}}}}};
  return all;
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Takes out of a section what `key` replaces.
void make_room(ConfigNode& section, const std::string& path, const std::string& key) {
  for (const Alternatives& set : alternatives()) {
    const auto own = std::find_if(set.keys.begin(), set.keys.end(), [&](const auto& keys) { return holds(keys, key); });
    if (own == set.keys.end() || !holds(set.sections, path)) continue;
    const auto replaced = [&](const ConfigNode::Entry& entry) {
      return !holds(*own, entry.key) &&
             std::any_of(set.keys.begin(), set.keys.end(), [&](const auto& keys) { return holds(keys, entry.key); });
    };
    auto& entries = section.entries;
    entries.erase(std::remove_if(entries.begin(), entries.end(), replaced), entries.end());
  }
}

/// The section that a path such as "vertical.tide" names; null where there is none.
ConfigNode* section_at(ConfigNode& root, std::string_view path) {
  ConfigNode* node = &root;
  while (node != nullptr && !path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    node = node->find(std::string(path.substr(0, dot)));
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return node;
}

/// Puts the sections of an including file over those of the file that it includes.
void lay_over(ConfigNode& under, ConfigNode over) {
  for (auto& entry : over.entries) {
    ConfigNode* section = under.find(entry.key);
    if (section == nullptr || !section->is_map() || !entry.value.is_map()) {
      under.set(entry.key, std::move(entry.value));
      continue;
    }
    for (auto& inner : entry.value.entries) {
      make_room(*section, entry.key, inner.key);
      section->set(inner.key, std::move(inner.value));
    }
  }
  under.place = over.place;
}

bool is_scenario(const ConfigNode& root) {
  const ConfigNode* format = root.find("ensonify");
  return format != nullptr && format->scalar == kScenarioFormat;
}

/// Nothing where there is no such key; one without a value is null.
std::optional<ConfigNode> taken(ConfigNode& root, const std::string& key) {
  const auto entry =
      std::find_if(root.entries.begin(), root.entries.end(), [&](const auto& e) { return e.key == key; });
  if (entry == root.entries.end()) return std::nullopt;
  ConfigNode value = std::move(entry->value);
  root.entries.erase(entry);
  return value;
}

/// The scenario of a file, or the one that a launch file has under `scenario`.
ConfigDocument parsed(const std::string& path) {
  ConfigDocument document = parse_config_file(path);
  const ConfigNode* inside = document.root.find("scenario");
  if (!is_scenario(document.root) && inside != nullptr && inside->is_map()) document.root = ConfigNode(*inside);
  return document;
}

ConfigDocument load(ConfigDocument document, std::vector<std::string> open) {
  const std::string path = document.root.place.file;
  const std::optional<ConfigNode> include = taken(document.root, "include");
  if (!include) return document;
  const auto refuse = [&](const std::string& why) {  // all else would follow from it
    document.problems.push_back({include->place, "include", why});
    throw ConfigError(document.problems);
  };
  if (!is_scenario(document.root))
    refuse(std::string("stands in a file that does not say \"ensonify: ") + kScenarioFormat + "\"");
  if (!include->is_scalar()) refuse("is not the file of a scenario");
  const std::string under = find_data(include->scalar, {std::filesystem::path(path).parent_path().string()});
  if (under.empty()) refuse("\"" + include->scalar + "\": no such file");
  open.push_back(std::filesystem::weakly_canonical(path).string());
  if (holds(open, std::filesystem::weakly_canonical(under).string()))
    refuse("\"" + include->scalar + "\" includes itself, directly or through others");
  ConfigDocument merged = load(parse_config_file(under), open);
  if (!is_scenario(merged.root)) refuse("\"" + include->scalar + "\" is no " + kScenarioFormat);
  lay_over(merged.root, std::move(document.root));
  merged.problems.insert(merged.problems.end(), document.problems.begin(), document.problems.end());
  return merged;
}

}  // namespace

ConfigDocument load_scenario(const std::string& path, const Overrides& overrides) {
  return load_scenario(parsed(path), overrides);
}

ConfigDocument load_scenario(ConfigDocument given, const Overrides& overrides) {
  ConfigDocument document = load(std::move(given), {});
  for (const auto& [key, value] : overrides) {
    for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', dot + 1)) {
      const std::string section = key.substr(0, dot);
      const std::string inner = key.substr(dot + 1, key.find('.', dot + 1) - dot - 1);
      if (ConfigNode* node = section_at(document.root, section)) make_room(*node, section, inner);
    }
  }
  const auto problems = apply(overrides, document.root);
  document.problems.insert(document.problems.end(), problems.begin(), problems.end());
  return document;
}

void TimeKeys::check(const ConfigReader& from) const {
  if (!parse_utc_ns(start_utc)) {
    from.problem("start_utc", "\"" + start_utc + "\" is not a UTC time such as 2025-06-01T12:00:00Z");
  }
}

ScenarioHeader HeaderKeys::header() const {
  ScenarioHeader header;
  header.seed = seed;
  header.start_utc = time.start_utc;
  header.start_unix_ns = parse_utc_ns(time.start_utc).value_or(header.start_unix_ns);
  return header;
}

void read_header(ConfigReader& from, ScenarioHeader& header) {
  HeaderKeys keys;
  read_parameters(from, keys);
  header = keys.header();
}

std::optional<std::int64_t> parse_utc_ns(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
  double second = 0.0;
  const int fields =
      std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf%n", &year, &month, &day, &hour, &minute, &second, &used);
  if (fields != 6 || text.substr(static_cast<std::size_t>(used)) != "Z") {
    return std::nullopt;
  }
  static constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  if (year < 1970 || year > 2200 || month < 1 || month > 12 || day < 1 ||
      day > kDays[month - 1] + (month == 2 && leap ? 1 : 0) || hour < 0 || hour > 23 || minute < 0 || minute > 59 ||
      !(second >= 0.0 && second < 60.0)) {
    return std::nullopt;
  }
  // Days since 1970-01-01 of a Gregorian date, counting years from March so that the leap day comes last.
  const std::int64_t y = month > 2 ? year : year - 1;
  const std::int64_t day_of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const std::int64_t days = 365 * y + y / 4 - y / 100 + y / 400 + day_of_year - 719468;
  const std::int64_t whole_s = ((days * 24 + hour) * 60 + minute) * 60;
  return whole_s * 1'000'000'000 + std::llround(second * 1e9);
}

}  // namespace ensonify
