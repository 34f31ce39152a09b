#include "components/navigation/usbl_tracker.h"

#include <fmt/format.h>

#include <numbers>

#include "components/navigation/world_frame.h"

namespace ensonify {
namespace {

constexpr SimTime kKept = 10_s;  // of the target's poses: an answer from 10 km is 7 s old

}  // namespace

UsblTracker::UsblTracker(const UsblConfig& config, std::uint64_t seed, const std::string& process, Ports& ports)
    : array_(config, random::Stream(seed, process + "/usbl")),
      target_(kKept.count()),
      fixes_out_(ports.out<msg::UsblFix>("usbl", {.rate = rate_of(config.instrument.rate_hz)})) {
  ports.in<msg::Pose>("target", [this](const msg::Pose& pose) { target_.push(pose.stamp_ns, moving_pose(pose).pose); });
}

void UsblTracker::step(SimTime now, const Moment* moment, Outbox& outbox) {
  const auto n = static_cast<std::uint64_t>(array_.due.count());
  if (!array_.due.due(now) || moment == nullptr) return;
  const UsblConfig& config = array_.config;
  const Instrument& instrument = config.instrument;
  const frames::HeadPose head = frames::head_pose(moment->truth.pose, instrument.actual);
  const auto transponder_enu_m = answered_enu_m(*moment, head.position_enu_m);
  silence_ = target_.empty() ? "usbl: no pose of the target has come" : "";
  if (!transponder_enu_m || !moment->estimated.position_enu_m || instrument.out_at(moment->t_s)) return;

  msg::UsblFix fix;
  const frames::Vec3 place_array_m = frames::head_from_enu(head, *transponder_enu_m);
  const auto reading = sensors::locate(config.errors, place_array_m, array_.sensor, n);
  if (!reading) silence_ = why_silent(place_array_m);
  double age_s = 0.0;
  if (reading) {
    const frames::Mounting& measured = instrument.measured;
    const frames::Vec3 place_body_m = measured.body_from_head * reading->place_array_m;
    const frames::Quaternion& enu_from_body = moment->estimated.enu_from_body;
    const frames::Vec3 position_enu_m =
        *moment->estimated.position_enu_m + enu_from_body * (measured.position_body_m + place_body_m);
    const Eigen::Matrix3d enu_from_array = (enu_from_body * measured.body_from_head).toRotationMatrix();
    const frames::Vec3 sigma_enu_m = (enu_from_array.cwiseAbs2() * reading->sigma_array_m.cwiseAbs2()).cwiseSqrt();
    const auto plain = [](const frames::Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
    fix.valid = true;
    fix.range_m = reading->place_array_m.norm();
    fix.place_body_m = plain(place_body_m);
    fix.position_enu_m = plain(position_enu_m);
    fix.sigma_enu_m = plain(sigma_enu_m);
    age_s = reading->age_s;
  }
  fix.stamp_ns = from_seconds(moment->stamp_s(instrument) - age_s).count();
  outbox.at(moment->now + from_seconds(instrument.latency_s), [this, fix] { fixes_out_.send(fix); });
}

std::optional<frames::Vec3> UsblTracker::answered_enu_m(const Moment& moment, const frames::Vec3& array_enu_m) const {
  // Later than the newest pose, the newest serves; what answered before the first is not known.
  const auto place_at = [&](double t_s) -> std::optional<frames::Vec3> {
    const std::int64_t t_ns = from_seconds(t_s).count();
    if (target_.empty() || t_ns < target_.oldest_ns()) return std::nullopt;
    const auto pose = target_.at(t_ns, frames::PoseHistory::Outside::kNearest);
    return frames::enu_from_body(*pose, array_.config.transponder_body_m);
  };
  std::optional<frames::Vec3> place = place_at(moment.t_s);
  for (int round = 0; place && round < 2; ++round) {  // each leaves speed / sound speed of what was wrong
    const double way_s = (*place - array_enu_m).norm() / array_.config.errors.speed_of_sound_mps;
    place = place_at(moment.t_s - way_s);
  }
  return place;
}

std::string UsblTracker::why_silent(const frames::Vec3& place_array_m) const {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const sensors::UsblErrors& errors = array_.config.errors;
  if (place_array_m.norm() > errors.longest_m) {
    return fmt::format("usbl: the transponder is {:.0f} m away, received within {:.0f}", place_array_m.norm(),
                       errors.longest_m);
  }
  return fmt::format(
      "usbl: the transponder is {:.0f} degrees off the array's axis, received within {:.0f}; turn the array",
      sensors::off_axis_rad(place_array_m) / kDegree, errors.widest_rad / kDegree);
}

}  // namespace ensonify
