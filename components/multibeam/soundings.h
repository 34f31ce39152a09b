#pragma once

#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/head.h"
#include "components/multibeam/relief_estimator.h"
#include "components/multibeam/steering.h"
#include "components/sonar/auto_range.h"
#include "components/sonar/sea_acoustics.h"
#include "kernels/acoustics/detect/bottom.h"
#include "kernels/base/frames/pose.h"
#include "kernels/water/refraction/profile.h"
#include "messages/soundings.h"

namespace ensonify {

/// Instrument's data of one echo: its estimated poses at transmission and at reception, the sines that it
/// steered its lines to (from the planes across the head's x axis at transmission, across y at reception), the speed of
/// sound that it steered with, and the two-way time.
struct MeasuredEcho {
  frames::HeadPose at_transmit;
  frames::HeadPose at_receive;
  double sin_transmit = 0.0;
  double sin_receive = 0.0;
  double face_speed_mps = 1500.0;
  double two_way_s = 0.0;
};

/// Origin of the echo in the water that the instrument assumes: along the direction in which both cones intersect
/// (georeference::intersect_cones), bent by the applied profile (georeference::place_sounding).
///
/// The head moves between transmission and reception. The ray is traced from half way between, and turned and shortened
/// by what a straight line to its end differs from there to the two places: exact in isovelocity water, else right to
/// the product of the shift over the range and the bending.
frames::Vec3 sounding_enu_m(const MeasuredEcho& measured, const refraction::SoundSpeedProfile& applied);

/// One detection of a ping: an entry of soundings/1.
struct Echo {
  int beam = 0;
  int detection = 0;  // of its beam, or of its place in the swath with high density
  int sector = 0;
  int place = 0;  // in Steering::sin_soundings
  detect::Detection measured;
};

/// Knowledge of the instrument about a ping: its settings (with the operator's absorption), the navigation estimate,
/// and what that states of its own errors. Never the truth.
struct InstrumentPing {
  const PingEvent& event;
  const HeadSettings& settings;
  const Steering& steering;
  const frames::PoseHistory& estimate;
  const uncertainty::Navigation& navigation;
};

/// Bottom detections of a ping.
struct Detected {
  std::vector<Echo> echoes;
  double echo_s = 0.0, sample_period_s = 0.0;  // of the received beams
};

/// Soundings of a ping.
struct Placed {
  std::vector<Echo> echoes;              // the detections behind the entries of the soundings
  msg::Soundings soundings;              // without settings and track
  std::vector<BottomDetection> bottoms;  // returns of the valid ones
};

/// The last stages of a ping, of an instrument that knows its measured mounting and the applied sound speed profile.
class SoundingMaker {
 public:
  /// The design must outlive it.
  SoundingMaker(const MultibeamConfig& config, const ArrayDesign& design);

  /// Scratch: its contents do not matter.
  struct Memory {
    std::vector<detect::Detection> detections;  // of one sector
    std::vector<ReliefEstimator::Sounding> profile;
    // Beams turned to the places where soundings are sought, of high density.
    std::vector<float> amplitude_upa;
    std::vector<std::complex<float>> positive_upa, negative_upa;
  };

  /// Fourth stage: bottom detections in what the beams of each sector receive.
  Detected detect(const InstrumentPing& ping, std::span<const MultibeamHead::Received> received, Memory& memory) const;

  /// Fifth stage: places of the detections and their uncertainty. Without an estimate none is valid. `relief` is what
  /// the pings before said of the seabed; this ping is added.
  Placed place(const InstrumentPing& ping, Detected detected, ReliefEstimator& relief, Memory& memory) const;

 private:
  /// Half-power widths on a level seabed.
  struct Footprint {
    double across_m, along_m;
  };

  frames::HeadPose estimated_pose(const frames::PoseHistory& estimate, SimTime t) const;
  MultibeamHead::Received at_places(const Steering& steering, std::size_t sector, const MultibeamHead::Received& beams,
                                    std::span<const int> beam_of_place, std::span<const float> sin_places,
                                    Memory& memory) const;
  static void flag(const Steering& steering, Placed& placed);
  void measure(const InstrumentPing& ping, std::size_t entry, double pulse_length_s, Placed& placed) const;
  void place(const InstrumentPing& ping, std::size_t entry, Placed& placed) const;
  uncertainty::Geometry motion(const InstrumentPing& ping) const;
  Footprint footprint(std::size_t entry, const frames::Vec3& away_enu_m, const Placed& placed) const;
  void update(ReliefEstimator& relief, const uncertainty::Geometry& motion, const frames::Vec3& head_enu_m,
              const Placed& placed, Memory& memory) const;
  void state_uncertainty(const InstrumentPing& ping, const uncertainty::Geometry& motion,
                         const frames::Vec3& head_enu_m, const ReliefEstimator& relief, Placed& placed) const;

  MultibeamConfig config_;
  refraction::SoundSpeedProfile applied_;
  const std::vector<SectorDesign>& sectors_;
};

}  // namespace ensonify
