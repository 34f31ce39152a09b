#pragma once

#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/detector.h"
#include "components/multibeam/relief_estimator.h"
#include "components/multibeam/steering.h"
#include "components/sonar/auto_range.h"
#include "kernels/base/frames/pose.h"
#include "kernels/water/refraction/profile.h"
#include "messages/soundings.h"

namespace ensonify {

/// Soundings of a ping.
struct Placed {
  std::vector<Echo> echoes;              // the detections behind the entries of the soundings
  msg::Soundings soundings;              // without settings and track
  std::vector<BottomDetection> bottoms;  // returns of the valid ones
};

/// The fifth stage of a ping: places of the detections and their uncertainty, of an instrument that knows its measured
/// mounting and the applied sound speed profile.
class SoundingMaker {
 public:
  /// Configuration and arrays outlive it.
  SoundingMaker(const MultibeamConfig& config, const ArrayDesign& arrays);

  /// Scratch: its contents do not matter.
  struct Memory {
    std::vector<ReliefEstimator::Sounding> profile;
  };

  /// Without an estimate none is valid. `relief` is what the pings before said of the seabed; this ping is added.
  Placed place(const InstrumentPing& ping, Detected detected, ReliefEstimator& relief, Memory& memory) const;

 private:
  /// Half-power widths on a level seabed.
  struct Footprint {
    double across_m, along_m;
  };

  static void flag(const Steering& steering, Placed& placed);
  void measure(const InstrumentPing& ping, std::size_t entry, double pulse_length_s, Placed& placed) const;
  void place(const InstrumentPing& ping, std::size_t entry, Placed& placed) const;
  uncertainty::Geometry motion(const InstrumentPing& ping) const;
  Footprint footprint(std::size_t entry, const frames::Vec3& away_enu_m, const Placed& placed) const;
  void update(ReliefEstimator& relief, const uncertainty::Geometry& motion, const frames::Vec3& head_enu_m,
              const Placed& placed, Memory& memory) const;
  void state_uncertainty(const InstrumentPing& ping, const uncertainty::Geometry& motion,
                         const frames::Vec3& head_enu_m, const ReliefEstimator& relief, Placed& placed) const;

  const MultibeamConfig& config_;
  refraction::SoundSpeedProfile applied_;
  const std::vector<SectorDesign>& sectors_;
};

}  // namespace ensonify
