#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "messages/sonar.h"

namespace ensonify {

/// Operator's settings of a head. A head's configuration holds it as it starts; commands change it.
struct HeadSettings {
  bool auto_range = false;            // the head chooses, up to range_m
  double range_m = 0.0;               // of reception
  double source_level_db = 0.0;       // re 1 uPa^2 at 1 m, rms, on the axis
  double pulse_length_s = 0.0;        // 0: the head chooses, by the range
  double gain_spreading_db = 0.0;     // gain in dB at range R: S log10(R / m) + 2 A R + O; this is S
  double gain_absorption_dbpm = 0.0;  // A
  double gain_offset_db = 0.0;        // O
  double swath_rad = 0.0;
  double ping_rate_hz = 0.0;  // at most
  std::string mode;           // in the words of the head's documentation

  bool operator==(const HeadSettings&) const = default;
};

/// Limits of a setting, inclusive. Nothing: the head has no such setting. Both the same: it is fixed.
struct SettingRange {
  double least = 0.0;
  double most = 0.0;
};

/// Limits of the settings of a head.
struct SettingLimits {
  std::optional<SettingRange> range_m, source_level_db, pulse_length_s, gain_spreading_db, gain_absorption_dbpm,
      gain_offset_db, swath_rad, ping_rate_hz;
  bool auto_range = false;  // a range of 0 is understood
  bool auto_pulse = false;  // a pulse length of 0 is understood
  /// The shortest pulse that can be sent at a range in m, of a head whose range asks for a pulse; else nothing.
  std::function<double(double)> shortest_pulse_s;
  std::vector<std::string> modes;  // empty: the head has no modes
};

/// The settings of a head in force, and those commanded for its next ping.
///
/// A command changes what it names. A value beyond the limits is clamped to them; one that the head cannot take (no
/// such setting, an unknown mode) is refused and the rest of the command obeyed. Both are reported in one line each,
/// and so is a pulse length that the commanded range does not allow: it stays commanded for nearer ranges.
class CommandedSettings {
 public:
  /// The limits are the caller's word: the settings to start with need not lie within them.
  CommandedSettings(HeadSettings start, SettingLimits limits);

  /// Takes a command for the next ping. Gives what was clamped or refused, and why: for the log.
  std::vector<std::string> command(const msg::SonarSettings& command);

  /// Settings of a ping that goes out now.
  const HeadSettings& at_ping() const { return next_; }

 private:
  SettingLimits limits_;
  HeadSettings next_;
};

/// Writes the settings into the message of a ping. What they do not know (frequency, pulse, beamwidths) is left alone;
/// a head that chooses its range writes that itself.
void fill(msg::AppliedSettings& applied, const HeadSettings& settings);

}  // namespace ensonify
