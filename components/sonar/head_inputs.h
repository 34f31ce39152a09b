#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/runtime/ports.h"
#include "components/sonar/settings.h"
#include "components/sonar/tile_set.h"
#include "kernels/base/frames/pose.h"
#include "kernels/survey/uncertainty/sounding.h"
#include "kernels/vehicle/vertical/tide.h"
#include "messages/declarations.h"
#include "messages/sonar.h"
#include "scenarios/world/world.h"

namespace ensonify {

/// Inputs of a head, and its ports: `pose` (the truth), `tile`, `release`, and, if they are connected, `mesh`,
/// `mesh_release`, `object`, `object_release`, `estimate`, `settings` and, of a head that has a probe at its face,
/// `sound_speed`. A command is received 100 ms later: it may well come from somebody who examines the head's own pings.
class HeadInputs {
 public:
  /// Channel of a head with settings of its own.
  struct Channel {
    std::string name;  // "": the only one
    HeadSettings settings;
    SettingLimits limits;
    std::vector<msg::SectorDeclaration> sectors;  // transmissions of a ping
  };
  struct Start {
    HeadMounting mounting;
    vertical::Tide tide;              // of the water that the head is to be under
    SimTime longest_ping{0};          // from transmission to the end of its processing: poses are kept for two of them
    double sound_speed_mps = 1500.0;  // assumed, until a probe reports
    bool probe = false;               // there is one
    std::vector<Channel> channels;
    trace::LevelOfDetail lod;
  };
  HeadInputs(Ports& ports, const Start& start);
  HeadInputs(const HeadInputs&) = delete;
  HeadInputs& operator=(const HeadInputs&) = delete;

  const frames::PoseHistory& truth() const { return truth_; }
  const frames::PoseHistory& estimate() const { return estimate_; }
  /// Errors that the newest estimate states; nothing where it does not state.
  const std::optional<uncertainty::Navigation>& navigation_errors() const { return navigation_errors_; }
  const trace::Scene& seabed() const { return tiles_.scene(); }
  const HeadMounting& mounting() const { return mounting_; }
  /// Assumed: of the probe, or what the head starts with.
  double sound_speed_mps() const { return probe_mps_.value_or(start_mps_); }
  /// The newest that the probe given.
  std::optional<double> probe_mps() const { return probe_mps_; }

  /// The settings of a channel for the ping that goes out now.
  const HeadSettings& settings_at_ping(std::size_t channel = 0) const { return settings_[channel].at_ping(); }

  /// Poses of the head during reception, by the estimate and the measured mounting.
  void fill_track(msg::HeadTrack& track, SimTime transmit, SimTime reception) const;

  /// Reason that the head cannot ping now; "" when it can. A head never pings on missing geometry.
  std::string obstacle(SimTime now) const;

 private:
  void command(const msg::SonarSettings& wanted);

  Ports& ports_;
  HeadMounting mounting_;
  frames::PoseHistory truth_, estimate_;
  std::optional<uncertainty::Navigation> navigation_errors_;
  TileSet tiles_;
  vertical::Tide tide_;
  double start_mps_;
  std::optional<double> probe_mps_;
  std::vector<std::string> names_;  // of channels
  std::vector<CommandedSettings> settings_;
};

}  // namespace ensonify
