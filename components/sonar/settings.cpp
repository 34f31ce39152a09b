#include "components/sonar/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "messages/fields.h"

namespace ensonify {
namespace {

/// Takes over one number of a command; whether it did.
bool take(const std::string& name, double wanted, const SettingLimit& limit, double& setting,
          std::vector<std::string>& remarks) {
  if (wanted == 0.0 && zero_chooses(name)) {
    if (limit.chosen) setting = name == "range_m" ? limit.most : 0.0;
    else remarks.push_back(name + "=0 refused: this head does not choose it");
    return limit.chosen;
  }
  if (limit.least == limit.most && wanted != limit.least) {
    remarks.push_back(fmt::format("{}={} refused: on this head it is fixed at {:.6g}", name, wanted, limit.least));
    return false;
  }
  setting = std::clamp(wanted, limit.least, limit.most);
  if (setting != wanted) {
    remarks.push_back(
        fmt::format("{}={} is outside [{}, {}]: set to {}", name, wanted, limit.least, limit.most, setting));
  }
  return true;
}

bool take(const std::string& name, const std::string& wanted, const SettingLimit& limit, std::string& setting,
          std::vector<std::string>& remarks) {
  const bool known = std::ranges::find(limit.words, wanted) != limit.words.end();
  if (known) setting = wanted;
  else remarks.push_back(fmt::format("{}={} refused: not one of {}", name, wanted, fmt::join(limit.words, ", ")));
  return known;
}

bool unchanged(double wanted) { return std::isnan(wanted); }
bool unchanged(const std::string& wanted) { return wanted.empty(); }

void report_longer_pulse(const SettingLimits& limits, const HeadSettings& settings, std::vector<std::string>& remarks) {
  if (!limits.shortest_pulse_s || settings.pulse_length_s == 0.0) return;
  const double shortest_s = limits.shortest_pulse_s(settings.range_m);
  if (settings.pulse_length_s >= (1.0 - 1e-9) * shortest_s) return;
  remarks.push_back(fmt::format("pulse_length_s={} is too short for range_m={}: {:.4g} is sent",
                                settings.pulse_length_s, settings.range_m, shortest_s));
}

}  // namespace

HeadSettings::HeadSettings() {
  for_settings(*this, [](auto&&, auto&&, auto&&, auto& setting) { setting = {}; });
}

bool HeadSettings::operator==(const HeadSettings& other) const {
  return auto_range == other.auto_range &&
         msg::to_value<msg::SonarSettings>(*this) == msg::to_value<msg::SonarSettings>(other);
}

CommandedSettings::CommandedSettings(HeadSettings start, SettingLimits limits)
    : limits_(std::move(limits)), next_(std::move(start)) {}

std::vector<std::string> CommandedSettings::command(const msg::SonarSettings& command) {
  std::vector<std::string> remarks;
  std::vector<const void*> members;
  for_settings(command, [&](auto&&, auto&&, auto&&, const auto& wanted) { members.push_back(&wanted); });
  auto member = members.begin();
  for_settings(next_, [&](const char* name, auto&&, auto&&, auto& setting) {
    const auto& wanted = *static_cast<const std::remove_cvref_t<decltype(setting)>*>(*member++);
    if (unchanged(wanted)) return;
    if (const SettingLimit* limit = limits_.find(name); limit == nullptr) {
      remarks.push_back(fmt::format("{}={} refused: this head has no such setting", name, wanted));
    } else if (take(name, wanted, *limit, setting, remarks) && name == std::string_view("range_m")) {
      next_.auto_range = command.range_m == 0.0;
    }
  });
  if (!std::isnan(command.range_m) || !std::isnan(command.pulse_length_s)) report_longer_pulse(limits_, next_, remarks);
  return remarks;
}

void fill(msg::AppliedSettings& applied, const HeadSettings& settings) {
  msg::AppliedSettings::fields(applied, [&](const std::string_view name, auto&&, auto&&, auto& in_force) {
    for_settings(settings, [&](const std::string_view setting, auto&&, auto&&, const auto& value) {
      if constexpr (std::is_same_v<decltype(in_force), std::remove_cvref_t<decltype(value)>&>) {
        if (name == setting) in_force = value;
      }
    });
  });
}

}  // namespace ensonify
