#pragma once

#include <complex>
#include <span>
#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/sector.h"
#include "components/multibeam/steering.h"
#include "kernels/acoustics/detect/bottom.h"
#include "kernels/base/frames/pose.h"
#include "kernels/survey/uncertainty/sounding.h"

namespace ensonify {

/// Knowledge of the instrument about a ping: its settings (with the operator's absorption), the navigation estimate,
/// and what that states of its own errors. Never the truth.
struct InstrumentPing {
  const PingEvent& event;
  const HeadSettings& settings;
  const Steering& steering;
  const frames::PoseHistory& estimate;
  const uncertainty::Navigation& navigation;

  /// Of the head, by the measured mounting. The estimate is not empty.
  frames::HeadPose head_pose(const frames::Mounting& measured, SimTime t) const {
    return frames::head_pose(*estimate.at(t.count(), frames::PoseHistory::Outside::kNearest), measured);
  }
};

/// One detection of a ping: an entry of soundings/1.
struct Echo {
  int beam = 0;
  int detection = 0;  // of its beam, or of its place in the swath with high density
  int sector = 0;
  int place = 0;  // in Steering::sin_soundings
  detect::Detection measured;
};

/// Bottom detections of a ping.
struct Detected {
  std::vector<Echo> echoes;
  double echo_s = 0.0, sample_period_s = 0.0;  // of the received beams
};

/// The fourth stage of a ping: bottom detections in what the beams of each sector receive.
class Detector {
 public:
  /// Configuration and arrays outlive it.
  Detector(const MultibeamConfig& config, const ArrayDesign& arrays);

  /// Scratch: its contents do not matter.
  struct Memory {
    std::vector<detect::Detection> detections;  // of one sector
    // Beams turned to the places where soundings are sought, of high density.
    std::vector<float> amplitude_upa;
    std::vector<std::complex<float>> positive_upa, negative_upa;
  };

  Detected detect(const InstrumentPing& ping, std::span<const SectorBeams> received, Memory& memory) const;

 private:
  detect::Settings settings_of(const InstrumentPing& ping, double echo_s) const;
  SectorBeams at_places(const Steering& steering, std::size_t sector, const SectorBeams& beams,
                        std::span<const int> beam_of_place, std::span<const float> sin_places, Memory& memory) const;

  const MultibeamConfig& config_;
  const std::vector<SectorDesign>& sectors_;
};

}  // namespace ensonify
