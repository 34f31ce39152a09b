#include "scenarios/world/sonar_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "components/config/config_reader.h"
#include "components/errors/assert.h"
#include "scenarios/world/mission.h"

namespace ensonify {
namespace {

constexpr double kRounding = 1e-6;  // relative: degrees of a file against a head's radians

bool is_setting(const std::string& field) {
  bool found = false;
  msg::SonarSettings settings;
  for_settings(settings, [&](const char* name, auto&&...) { found = found || field == name; });
  return found;
}

/// What is wrong with a value, "" when nothing is.
std::string fault(const std::string& head, const std::string& field, double value, const SettingLimit& limit,
                  double si) {
  const auto in_file = [&](double number) { return fmt::format("{:.6g}", number / si); };
  const std::string range = fmt::format("[{}, {}]", in_file(limit.least), in_file(limit.most));
  if (value == 0.0 && zero_chooses(field)) {
    return limit.chosen ? "" : fmt::format("0 leaves it to {}, which does not choose; allowed: {}", head, range);
  }
  const double slack = kRounding * std::max(std::abs(limit.least), std::abs(limit.most));
  if (value >= limit.least - slack && value <= limit.most + slack) return "";
  return fmt::format("{} is outside {}, the limits of {}", in_file(value), range, head);
}

std::string fault(const std::string& head, const std::string&, const std::string& value, const SettingLimit& limit,
                  double) {
  if (std::ranges::find(limit.words, value) != limit.words.end()) return "";
  return fmt::format("{} is no word of {}; allowed: {}", value, head, fmt::join(limit.words, ", "));
}

}  // namespace

SettingInFile setting_in_file(const std::string& name, const std::string& unit) {
  if (unit != "rad") return {name, unit};
  return {name.substr(0, name.size() - 4) + "_deg", "deg", kDegrees.si};
}

SettingLimit& SettingLimits::operator[](const std::string& field) {
  ENSONIFY_ASSERT(is_setting(field), field + " is no field of sonar_settings/1");
  return limits_[field];
}

const SettingLimit* SettingLimits::find(const std::string& field) const {
  const auto found = limits_.find(field);
  return found == limits_.end() ? nullptr : &found->second;
}

void SettingLimits::widen(const SettingLimits& other) {
  for (const auto& [field, limit] : other.limits_) {
    const auto [found, is_new] = limits_.emplace(field, limit);
    if (is_new) continue;
    SettingLimit& both = found->second;
    both.least = std::min(both.least, limit.least);
    both.most = std::max(both.most, limit.most);
    both.chosen = both.chosen || limit.chosen;
    both.words.insert(both.words.end(), limit.words.begin(), limit.words.end());
  }
}

std::vector<msg::SettingDeclaration> SettingLimits::declared() const {
  std::vector<msg::SettingDeclaration> declared;
  for (const auto& [field, limit] : limits_)
    declared.push_back({field, limit.least, limit.most, limit.chosen, limit.words});
  return declared;
}

SettingLimits SettingLimits::of(const msg::HeadDeclaration& head) {
  SettingLimits all;
  for (const msg::ChannelDeclaration& channel : head.channels) {
    SettingLimits limits;
    for (const msg::SettingDeclaration& declared : channel.settings)
      limits.limits_[declared.setting] = {{declared.least, declared.most}, declared.chosen, declared.words};
    all.widen(limits);
  }
  return all;
}

std::vector<ConfigProblem> setting_problems(const Mission& mission,
                                            const std::map<std::string, msg::HeadDeclaration>& heads) {
  std::vector<ConfigProblem> problems;
  for (const MissionStep& step : mission.steps) {
    const auto* sonar = std::get_if<SetSonar>(&step);
    if (sonar == nullptr) continue;
    const auto head = heads.find(sonar->head);
    if (head == heads.end() || head->second.channels.empty()) continue;
    const SettingLimits limits = SettingLimits::of(head->second);
    for_settings(sonar->settings, [&](const char* name, const char* unit, const char*, const auto& value) {
      const auto given = sonar->given.find(name);
      if (given == sonar->given.end()) return;
      const SettingLimit* limit = limits.find(name);
      ConfigProblem problem = given->second;
      problem.message = limit != nullptr ? fault(sonar->head, name, value, *limit, setting_in_file(name, unit).si)
                                         : sonar->head + " has no such setting";
      if (!problem.message.empty()) problems.push_back(std::move(problem));
    });
  }
  return problems;
}

}  // namespace ensonify
