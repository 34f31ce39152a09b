#pragma once

#include "components/tracks/followed_track.h"
#include "components/vehicle/dynamics.h"
#include "kernels/vehicle/vertical/floating.h"

namespace ensonify {

/// A vehicle that goes along a recorded track, whatever it is commanded. Where the track gives no height it is at the
/// mission's depth below the water level, or floats on it, with the heave that was recorded.
class RecordedDynamics : public Dynamics {
 public:
  RecordedDynamics(const VehicleConfig& config, SimTime now);

  void advance(SimTime now) override;
  void command(double, double, std::optional<double>) override {}
  frames::MovingPose moving() const override;

 private:
  double speed_through_water_mps() const;

  std::shared_ptr<const tracks::FollowedTrack> track_;
  VehicleWater water_;
  double depth_m_;
  SimTime now_;
  vertical::Floating floating_;
};

}  // namespace ensonify
