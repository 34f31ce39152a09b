#pragma once

#include <string>
#include <vector>

#include "messages/sonar.h"
#include "scenarios/world/sonar_settings.h"

namespace ensonify {

/// Operator's settings of a head. A head's configuration holds it as it starts; commands change it.
struct HeadSettings : msg::SonarSettings {
  bool auto_range = false;  // the head chooses, up to range_m

  /// Every number 0, every text empty.
  HeadSettings();
  bool operator==(const HeadSettings& other) const;
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
