#include "components/sonar/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ensonify {
namespace {

/// Takes over one number of a command.
void take(const char* name, double wanted, const std::optional<SettingRange>& range, double& setting,
          std::vector<std::string>& remarks) {
  if (std::isnan(wanted)) return;
  if (!range) {
    remarks.push_back(fmt::format("{}={} refused: this head has no such setting", name, wanted));
    return;
  }
  if (range->least == range->most && wanted != range->least) {
    remarks.push_back(fmt::format("{}={} refused: on this head it is fixed at {:.6g}", name, wanted, range->least));
    return;
  }
  setting = std::clamp(wanted, range->least, range->most);
  if (setting != wanted) {
    remarks.push_back(
        fmt::format("{}={} is outside [{}, {}]: set to {}", name, wanted, range->least, range->most, setting));
  }
}

void take_range(double wanted_m, const SettingLimits& limits, HeadSettings& settings,
                std::vector<std::string>& remarks) {
  if (std::isnan(wanted_m)) return;
  const bool automatic = wanted_m == 0.0;
  if (automatic && limits.range_m && !limits.auto_range) {
    remarks.push_back("range_m=0 refused: this head does not choose its range");
    return;
  }
  if (automatic && limits.range_m) {
    settings.auto_range = true;
    settings.range_m = limits.range_m->most;
    return;
  }
  take("range_m", wanted_m, limits.range_m, settings.range_m, remarks);
  if (limits.range_m) settings.auto_range = false;
}

void take_pulse(double wanted_s, const SettingLimits& limits, HeadSettings& settings,
                std::vector<std::string>& remarks) {
  if (wanted_s != 0.0 || !limits.pulse_length_s) {
    take("pulse_length_s", wanted_s, limits.pulse_length_s, settings.pulse_length_s, remarks);
  } else if (limits.auto_pulse) {
    settings.pulse_length_s = 0.0;
  } else {
    remarks.push_back("pulse_length_s=0 refused: this head does not choose its pulse length");
  }
}

void report_longer_pulse(const SettingLimits& limits, const HeadSettings& settings, std::vector<std::string>& remarks) {
  if (!limits.shortest_pulse_s || settings.pulse_length_s == 0.0) return;
  const double shortest_s = limits.shortest_pulse_s(settings.range_m);
  if (settings.pulse_length_s >= (1.0 - 1e-9) * shortest_s) return;
  remarks.push_back(fmt::format("pulse_length_s={} is too short for range_m={}: {:.4g} is sent",
                                settings.pulse_length_s, settings.range_m, shortest_s));
}

void take_mode(const std::string& wanted, const std::vector<std::string>& modes, std::string& mode,
               std::vector<std::string>& remarks) {
  if (wanted.empty()) return;
  if (std::find(modes.begin(), modes.end(), wanted) != modes.end()) {
    mode = wanted;
    return;
  }
  remarks.push_back(
      fmt::format("mode={} refused: {}", wanted,
                  modes.empty() ? "this head has no modes" : fmt::format("not one of {}", fmt::join(modes, ", "))));
}

}  // namespace

CommandedSettings::CommandedSettings(HeadSettings start, SettingLimits limits)
    : limits_(std::move(limits)), next_(std::move(start)) {}

std::vector<std::string> CommandedSettings::command(const msg::SonarSettings& command) {
  std::vector<std::string> remarks;
  const auto number = [&](const char* name, double wanted, const std::optional<SettingRange>& range, double& setting) {
    take(name, wanted, range, setting, remarks);
  };
  take_range(command.range_m, limits_, next_, remarks);
  number("source_level_db", command.source_level_db, limits_.source_level_db, next_.source_level_db);
  take_pulse(command.pulse_length_s, limits_, next_, remarks);
  if (!std::isnan(command.range_m) || !std::isnan(command.pulse_length_s)) report_longer_pulse(limits_, next_, remarks);
  number("gain_spreading_db", command.gain_spreading_db, limits_.gain_spreading_db, next_.gain_spreading_db);
  number("gain_absorption_dbpm", command.gain_absorption_dbpm, limits_.gain_absorption_dbpm,
         next_.gain_absorption_dbpm);
  number("gain_offset_db", command.gain_offset_db, limits_.gain_offset_db, next_.gain_offset_db);
  number("swath_rad", command.swath_rad, limits_.swath_rad, next_.swath_rad);
  number("ping_rate_hz", command.ping_rate_hz, limits_.ping_rate_hz, next_.ping_rate_hz);
  take_mode(command.mode, limits_.modes, next_.mode, remarks);
  return remarks;
}

void fill(msg::AppliedSettings& applied, const HeadSettings& settings) {
  applied.range_m = settings.range_m;
  applied.source_level_db = settings.source_level_db;
  applied.pulse_length_s = settings.pulse_length_s;
  applied.gain_spreading_db = settings.gain_spreading_db;
  applied.gain_absorption_dbpm = settings.gain_absorption_dbpm;
  applied.gain_offset_db = settings.gain_offset_db;
  applied.swath_rad = settings.swath_rad;
  applied.ping_rate_hz = settings.ping_rate_hz;
  applied.mode = settings.mode;
}

}  // namespace ensonify
