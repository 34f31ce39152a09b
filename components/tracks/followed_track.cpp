#include "components/tracks/followed_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/errors/exit_error.h"
#include "kernels/base/frames/attitude.h"
#include "kernels/vehicle/motion/lever.h"

namespace ensonify::tracks {
namespace {

constexpr double kNoise_m = 1.0;       // by which places may err without a speed that is refused
constexpr double kUnderWay_mps = 0.3;  // slower, the way has no direction
constexpr double kBridged_s = 0.001;   // of rounded times

motion::Moving value_at(const motion::GappedCurve& curve, double t_s) {
  return curve.empty() ? motion::Moving{} : curve.at(t_s);
}

std::optional<frames::LocalProjection> projection_of(const Track& track,
                                                     const std::optional<frames::Geodetic>& origin) {
  if (track.fixes.empty()) return std::nullopt;
  const frames::Geodetic& first = track.fixes.front().place;
  const auto site = [&] {
    return fmt::format("allowed: site: {{ latitude_deg: {:.4f}, longitude_deg: {:.4f} }}", first.latitude_deg,
                       first.longitude_deg);
  };
  if (!origin)
    throw UserError(fmt::format("{}: the site's origin is that of its raster, which is not known before the run; {}",
                                track.file, site()));
  const frames::LocalProjection world(*origin);
  for (const Fix& fix : track.fixes) {
    const double off_m = world.enu_of(fix.place).norm();
    if (off_m <= kFarAway_m) continue;
    throw UserError(
        fmt::format("{}: the track comes to {:.4f}, {:.4f}, more than 100 km from the site's origin at "
                    "{:.4f}, {:.4f}; {}",
                    track.file, fix.place.latitude_deg, fix.place.longitude_deg, origin->latitude_deg,
                    origin->longitude_deg, site()));
  }
  return world;
}

}  // namespace

FollowedTrack::FollowedTrack(const Track& track, const FollowTrack& wanted,
                             const std::optional<frames::Geodetic>& origin, double fastest_mps)
    : file_(track.file),
      wanted_(wanted),
      heading_rad_({wanted.longest_gap_s + kBridged_s, 0.0}),
      roll_rad_(heading_rad_),
      pitch_rad_(heading_rad_),
      height_m_(heading_rad_) {
  place(track, origin, fastest_mps);

  const bool any = !(track.roll_rad.empty() && track.pitch_rad.empty() && track.heave_m.empty());
  if (!any && wanted.attitude == FollowTrack::Attitude::kRecorded)
    throw UserError(track.file + ": holds no roll, pitch or heave; allowed: attitude: modelled");
  attitude_is_recorded_ = any && wanted.attitude != FollowTrack::Attitude::kModelled;
  if (attitude_is_recorded_) {
    take(track.roll_rad, "roll", roll_rad_);
    take(track.pitch_rad, "pitch", pitch_rad_);
  }
  const bool high = !track.height_m.empty(), deep = !track.depth_m.empty();
  if (!high && !deep && wanted.height == FollowTrack::Height::kRecorded)
    throw UserError(track.file + ": holds neither height nor depth; allowed: height: water");
  if ((high || deep) && wanted.height != FollowTrack::Height::kWater) {
    height_ = high ? Height::kDatum : Height::kDepth;
    take(high ? track.height_m : track.depth_m, high ? "height" : "depth", height_m_);
  } else if (attitude_is_recorded_) {
    take(track.heave_m, "heave", height_m_);
  }
  track.heading_rad.empty() ? head_along_the_way() : take_heading(track);
}

/// Places in the world, by their own times.
void FollowedTrack::place(const Track& track, const std::optional<frames::Geodetic>& origin, double fastest_mps) {
  world_ = projection_of(track, origin);
  std::vector<Spot> placed = track.spots;
  for (const Fix& fix : track.fixes) placed.push_back({fix.ns, world_->enu_of(fix.place)});
  if (placed.size() < 2) throw UserError(file_ + ": has a single place; allowed: a track of two at least");
  zero_ns_ = placed.front().ns + std::llround(1e9 * wanted_.from_s);
  const double last_s = run_s(placed.back().ns);
  const auto length = [&] { return fmt::format("the {:.3f} s that the track has", file_s(last_s)); };
  if (last_s <= 0.0)
    throw UserError(fmt::format("{}: from_s {:g} is beyond {}; allowed: less", file_, wanted_.from_s, length()));
  end_s_ = wanted_.to_s ? *wanted_.to_s - wanted_.from_s : last_s;
  if (end_s_ > last_s)
    throw UserError(fmt::format("{}: to_s {:g} is beyond {}; allowed: no more", file_, *wanted_.to_s, length()));

  for (std::size_t i = 0; i < placed.size(); ++i) {
    const double t_s = run_s(placed[i].ns);
    if (i > 0) {
      const double before_s = run_s(placed[i - 1].ns);
      check_gap(before_s, t_s, "place");
      const double way_m = (placed[i].place_enu_m - placed[i - 1].place_enu_m).norm();
      if (t_s >= 0.0 && before_s <= end_s_ && way_m > fastest_mps * (t_s - before_s) + kNoise_m) {
        throw UserError(fmt::format(
            "{}: goes {:.1f} m from {:.3f} to {:.3f} s, at {:.3g} m/s; allowed: fastest_mps of the vehicle, {:g}, or "
            "another part (from_s, to_s)",
            file_, way_m, file_s(before_s), file_s(t_s), way_m / (t_s - before_s), fastest_mps));
      }
    }
    times_s_.push_back(t_s);
    east_m_.push(t_s, placed[i].place_enu_m.x());
    north_m_.push(t_s, placed[i].place_enu_m.y());
  }
}

/// Of samples that follow each other, where the part between them is followed.
void FollowedTrack::check_gap(double from_s, double to_s, const char* what) const {
  const double within_from_s = std::max(from_s, 0.0), within_to_s = std::min(to_s, end_s_);
  if (within_to_s <= within_from_s || to_s - from_s <= wanted_.longest_gap_s + kBridged_s) return;
  throw UserError(
      fmt::format("{}: has no {} from {:.3f} to {:.3f} s; allowed: {:g} s without (longest_gap_s), or "
                  "another part (from_s, to_s)",
                  file_, what, file_s(from_s), file_s(to_s), wanted_.longest_gap_s));
}

void FollowedTrack::take(const std::vector<Value>& values, const char* what, motion::GappedCurve& curve) const {
  if (values.empty()) return;
  check_gap(0.0, run_s(values.front().ns), what);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) check_gap(run_s(values[i - 1].ns), run_s(values[i].ns), what);
    curve.push(run_s(values[i].ns), values[i].value);
  }
  check_gap(run_s(values.back().ns), end_s_, what);
}

void FollowedTrack::take_heading(const Track& track) {
  std::vector<Value> unwound;
  for (const Value& true_heading : track.heading_rad) {
    const double t_s = run_s(true_heading.ns);
    double grid_rad = true_heading.value;
    if (world_) grid_rad -= world_->convergence_rad({east_m_.at(t_s).value, north_m_.at(t_s).value});
    const double before_rad = unwound.empty() ? grid_rad : unwound.back().value;
    unwound.push_back({true_heading.ns, before_rad + frames::wrap_pi(grid_rad - before_rad)});
  }
  take(unwound, "heading", heading_rad_);
}

/// Without a heading of its own the vehicle looks where it goes; where it lies still, where it last went.
void FollowedTrack::head_along_the_way() {
  std::optional<double> before_rad;
  std::vector<double> still_s;  // since the beginning
  for (const double t_s : times_s_) {
    const Moving east = east_m_.at(t_s), north = north_m_.at(t_s);
    if (std::hypot(east.rate, north.rate) < kUnderWay_mps) {
      if (before_rad) heading_rad_.push(t_s, *before_rad);
      else still_s.push_back(t_s);
      continue;
    }
    const double course_rad = std::atan2(east.rate, north.rate);
    if (!before_rad) {
      for (const double at_s : still_s) heading_rad_.push(at_s, course_rad);
      before_rad = course_rad;
    }
    *before_rad += frames::wrap_pi(course_rad - *before_rad);
    heading_rad_.push(t_s, *before_rad);
  }
  if (!before_rad)
    throw UserError(
        fmt::format("{}: has no heading, and never goes faster than {:g} m/s; allowed: a track with headings", file_,
                    kUnderWay_mps));
}

frames::MovingPose FollowedTrack::at(double t_s) const {
  const double within_s = std::clamp(t_s, 0.0, end_s_);
  Moving height_m = value_at(height_m_, within_s);
  if (height_ == Height::kDepth) height_m = {-height_m.value, -height_m.rate, -height_m.acceleration};
  // Off a body that lies level at the world's origin with its bow to north. First as if it were at what was tracked.
  const motion::Excursion way{
      north_m_.at(within_s),         east_m_.at(within_s),           height_m,
      value_at(roll_rad_, within_s), value_at(pitch_rad_, within_s), value_at(heading_rad_, within_s)};
  frames::MovingPose moving = motion::superimpose(frames::MovingPose{}, way);
  const double height_before_m = moving.pose.position_enu_m.z();
  moving = motion::reference_point(moving, wanted_.position_body_m);
  if (height_ == Height::kWaterLevel) {  // heave is of the reference point
    moving.pose.position_enu_m.z() = height_before_m;
    moving.velocity_enu_mps.z() = height_m.rate;
    moving.acceleration_enu_mps2.z() = height_m.acceleration;
  }
  if (t_s <= end_s_) return moving;
  return frames::MovingPose{.pose = moving.pose};
}

FollowedTrack followed_track(const FollowTrack& wanted, const std::optional<frames::Geodetic>& origin,
                             double fastest_mps) {
  return FollowedTrack(read_track(wanted.file, wanted.topic), wanted, origin, fastest_mps);
}

}  // namespace ensonify::tracks
