#pragma once

#include <string>

#include "components/runtime/config/scenario.h"
#include "components/runtime/head/settings.h"
#include "components/runtime/head/tile_set.h"
#include "components/runtime/ports.h"
#include "kernels/frames/pose.h"

namespace ensonify {

/// What a head is told, and its ports: `pose` (the truth), `estimate`, `tile`, `release`, and, if they are connected,
/// `sound_speed` (the probe at the face) and `settings`. A command is heard 100 ms later: it may well come from
/// somebody who looks at the head's own pings.
class HeadInputs {
 public:
  struct Start {
    frames::Mounting actual;
    SimTime keep{0};                  // poses older than this are never asked for
    double sound_speed_mps = 1500.0;  // believed until the probe tells
    HeadSettings settings;
    SettingLimits limits;
  };
  HeadInputs(Ports& ports, const Start& start);
  HeadInputs(const HeadInputs&) = delete;
  HeadInputs& operator=(const HeadInputs&) = delete;

  const frames::PoseHistory& truth() const { return truth_; }
  const frames::PoseHistory& estimate() const { return estimate_; }
  const trace::Scene& seabed() const { return tiles_.scene(); }
  double sound_speed_mps() const { return sound_speed_mps_; }
  CommandedSettings& settings() { return settings_; }

  /// Why the head cannot ping now; "" when it can. A head never pings on missing geometry.
  std::string obstacle(SimTime now) const;

 private:
  void command(const msg::SonarSettings& wanted);

  Ports& ports_;
  frames::Mounting actual_;
  frames::PoseHistory truth_, estimate_;
  TileSet tiles_;
  double sound_speed_mps_;
  CommandedSettings settings_;
};

}  // namespace ensonify
