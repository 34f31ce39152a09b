#include "components/logger/vessel.h"

namespace ensonify::logger {

using frames::Vec3;

namespace {

// Centre array of an EM 2040's transmitter, and its receiver, from the installed point: forward, starboard, down.
const Vec3 kTransmitCentre_m(0.0, 0.0131, -0.006);
const Vec3 kReceiveCentre_m(0.011, 0.0, -0.006);

}  // namespace

Vec3 Vessel::transmitter_body_m() const { return head.position_body_m - head.body_from_head * kTransmitCentre_m; }
Vec3 Vessel::receiver_body_m() const { return head.position_body_m - head.body_from_head * kReceiveCentre_m; }

frames::Pose Vessel::body_pose(const frames::HeadPose& head_pose) const {
  const frames::Quaternion enu_from_body = head_pose.enu_from_head * head.body_from_head.conjugate();
  return {head_pose.position_enu_m - enu_from_body * head.position_body_m, enu_from_body};
}

Vec3 Vessel::horizontal_origin_enu_m(const frames::Pose& body) const {
  return frames::enu_from_body(body, Vec3(0.0, 0.0, water_line_m));
}

double Vessel::transducer_depth_m(const frames::Pose& body, double heave_down_m) const {
  const double below_reference_m = -(body.enu_from_body * head.position_body_m).z();
  return below_reference_m + heave_down_m - water_line_m;
}

}  // namespace ensonify::logger
