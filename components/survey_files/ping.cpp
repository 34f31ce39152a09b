#include "components/survey_files/ping.h"

#include <cmath>
#include <utility>

#include "kernels/survey/georeference/two_way.h"

namespace ensonify::survey_files {

using frames::Vec3;

Water water_below(double transducer_depth_m, double face_speed_mps, const std::vector<refraction::Knot>& profile) {
  constexpr double kLeastStep_m = 1e-3;
  std::vector<refraction::Knot> knots{{transducer_depth_m, face_speed_mps}};
  for (const refraction::Knot& knot : profile) {
    if (knot.depth_m > knots.back().depth_m + kLeastStep_m) knots.push_back(knot);
  }
  return {face_speed_mps, refraction::SoundSpeedProfile(std::move(knots))};
}

Water water_of_profile(double transducer_depth_m, const std::vector<refraction::Knot>& profile) {
  refraction::SoundSpeedProfile whole(profile);
  return {whole.speed_mps(transducer_depth_m), std::move(whole)};
}

std::optional<Vec3> place_enu_m(const Measured& measured, const Water& water, const Track& track) {
  constexpr double kLongest_s = 100.0, kMostAlong = 0.9;
  const bool times = std::abs(measured.delay_s) < kLongest_s && std::abs(measured.two_way_s) < kLongest_s;  // not NaN
  if (!times || !std::isfinite(measured.tilt_rad + measured.angle_rad)) return std::nullopt;
  const std::int64_t transmit_ns = measured.ping_ns + std::llround(1e9 * measured.delay_s);
  const auto at_transmit = track.at(transmit_ns);
  const auto at_receive = track.at(transmit_ns + std::llround(1e9 * measured.two_way_s));
  if (!at_transmit || !at_receive) return std::nullopt;
  const georeference::MeasuredEcho echo{
      .at_transmit = frames::head_pose(*at_transmit, measured.transmitter->mounting(measured.transmit_centre)),
      .at_receive = frames::head_pose(*at_receive, measured.receiver->mounting(0)),
      .sin_transmit = std::sin(measured.tilt_rad),
      .sin_receive = std::sin(measured.angle_rad),
      .face_speed_mps = water.face_speed_mps,
      .two_way_s = measured.two_way_s};
  const double along =
      (echo.at_transmit.enu_from_head * Vec3::UnitX()).dot(echo.at_receive.enu_from_head * Vec3::UnitY());
  if (!(std::abs(along) < kMostAlong)) return std::nullopt;
  return georeference::sounding_enu_m(echo, water.profile);
}

frames::Quaternion level_from_enu(const frames::Pose& body) {
  const frames::Attitude level{.heading_rad = frames::attitude_of(body.enu_from_body).heading_rad};
  return frames::enu_from_body(level).conjugate();
}

}  // namespace ensonify::survey_files
