#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

#include "components/errors/exit_error.h"
#include "components/formats/kmall/reader.h"
#include "components/survey_files/survey_file.h"

namespace ensonify::survey_files {
namespace {

using namespace formats::kmall;
using frames::Vec3;
using Knots = std::vector<refraction::Knot>;

Moved moved_of(const Motion::Sample& sample) {
  return {std::int64_t{sample.time_s} * 1'000'000'000 + sample.time_ns, sample.roll_deg, sample.pitch_deg,
          sample.heading_deg, sample.heave_m};
}

/// A .kmall file, read twice: what holds at a time first, then its pings.
class File {
 public:
  File(const std::string& file, const Trace& trace) : file_(file), trace_(trace) {
    std::vector<Moved> motion;
    Fixes of_others, of_pings;  // systems than the active one
    each_datagram<Reader>(file_, [&](const Datagram& datagram) {
      if (const auto* text = std::get_if<Installation>(&datagram.body); text != nullptr && !vessel_)
        vessel_ = vessel_of_kmall(file_, text->text);
      if (const auto* profile = std::get_if<formats::kmall::SoundSpeedProfile>(&datagram.body))
        profiles_[datagram.unix_ns()] = knots_of(*profile);
      if (const auto* position = std::get_if<Position>(&datagram.body))
        ((position->sensor.status & 1U) != 0 ? fixes_ : of_others)
            .add(datagram.unix_ns(), {position->latitude_deg, position->longitude_deg});
      if (const auto* ping = std::get_if<Soundings>(&datagram.body))
        of_pings.add(datagram.unix_ns(), {ping->pose.latitude_deg, ping->pose.longitude_deg});
      if (const auto* samples = std::get_if<Motion>(&datagram.body);
          samples != nullptr && vessel_ && samples->sensor == vessel_->motion_sensor)
        std::ranges::transform(samples->samples, std::back_inserter(motion), moved_of);
    });
    if (!vessel_) throw UserError(file_ + ": holds no installation (#IIP)");
    if (profiles_.empty()) throw UserError(file_ + ": holds no sound speed profile (#SVP)");
    if (motion.empty()) throw UserError(file_ + ": holds no attitude (#SKM)");
    if (fixes_.empty()) fixes_ = std::move(of_others);
    if (fixes_.empty()) fixes_ = std::move(of_pings);
    if (fixes_.empty()) throw UserError(file_ + ": holds no position (#SPO)");
    make_track(motion);
  }

  Summary place(const TakePlaced& take) {
    Summary summary;
    summary.faults = each_datagram<Reader>(file_, [&](const Datagram& datagram) {
      if (const auto* ping = std::get_if<Soundings>(&datagram.body)) place(*ping, datagram.unix_ns(), take, summary);
    });
    return summary;
  }

 private:
  Knots knots_of(const formats::kmall::SoundSpeedProfile& profile) const {
    Knots knots;
    for (const auto& node : profile.nodes) add_node(file_, node.depth_m, node.sound_speed_mps, knots);
    if (knots.empty()) throw UserError(file_ + ": its profile has no node");
    return knots;
  }

  /// Heights of the reference point count from the water line: by heave, and the water line of the vessel at rest.
  void make_track(const std::vector<Moved>& motion) {
    for (const Moved& one : motion) {
      if (!one.finite()) continue;
      frames::Pose body;
      body.position_enu_m.head<2>() = fixes_.enu_at(one.unix_ns);
      body.position_enu_m.z() = vessel_->water_line_m - static_cast<double>(one.heave_down_m);
      body.enu_from_body = frames::enu_from_ned() * turn_of(one.roll_deg, one.pitch_deg, one.heading_deg) *
                           vessel_->body_from_motion_sensor.conjugate();
      track_.add(one.unix_ns, body);
    }
    track_.sort();
  }

  void place(const Soundings& ping, std::int64_t unix_ns, const TakePlaced& take, Summary& summary) const {
    ++summary.pings;
    const std::size_t transmitter = std::min<std::size_t>(ping.ping.transmitter, vessel_->transmitters.size() - 1),
                      receiver = std::min<std::size_t>(ping.ping.receiver, vessel_->receivers.size() - 1);
    const auto body = track_.at(unix_ns);
    const auto moving = track_.moving_at(unix_ns);
    const auto profile = profiles_.upper_bound(unix_ns);
    const Knots& in_force = profile == profiles_.begin() ? profile->second : std::prev(profile)->second;
    std::optional<Water> water;
    if (body) {
      const auto face = frames::head_pose(*body, vessel_->transmitters[transmitter].mounting(1));
      const double depth_m = -face.position_enu_m.z();
      water =
          trace_.surface_speed ? water_below(depth_m, face_speed(ping), in_force) : water_of_profile(depth_m, in_force);
    }
    for (const Sounding& one : ping.soundings) {
      if (!one.valid() || one.sector >= ping.sectors.size()) {
        ++summary.rejected;
        continue;
      }
      const Soundings::Sector& sector = ping.sectors[one.sector];
      const Measured measured{
          .ping_ns = unix_ns,
          .delay_s = static_cast<double>(sector.delay_s),
          .two_way_s = static_cast<double>(one.travel_time_s) + static_cast<double>(one.travel_time_correction_s),
          .tilt_rad = kDegree * static_cast<double>(sector.tilt_deg),
          .angle_rad = -kDegree * (static_cast<double>(one.angle_deg) + static_cast<double>(one.angle_correction_deg)),
          .transmitter = &vessel_->transmitters[transmitter],
          .receiver = &vessel_->receivers[receiver],
          .transmit_centre = sector.array};
      const auto place = water ? place_enu_m(measured, *water, track_) : std::nullopt;
      if (!place) {
        ++summary.without_attitude;
        continue;
      }
      if (!place->allFinite()) {
        ++summary.rejected;
        continue;
      }
      ++summary.soundings;
      Placed found = placed(ping, one, unix_ns, *body, *place);
      found.body = moving;
      found.head_enu_m =
          frames::head_pose(*body, measured.transmitter->mounting(measured.transmit_centre)).position_enu_m;
      take(found);
    }
  }

  double face_speed(const Soundings& ping) const {
    return checked_speed(file_, ping.pose.sound_speed_mps, fmt::format("ping {} at the transducer", ping.ping.ping));
  }

  Placed placed(const Soundings& ping, const Sounding& one, std::int64_t unix_ns, const frames::Pose& body,
                const Vec3& place_enu_m) const {
    Placed placed{.ping = ping.ping.ping, .head = ping.ping.fan, .sounding = one.index, .unix_ns = unix_ns};
    placed.place_m = level_from_enu(body) * (place_enu_m - body.position_enu_m);
    placed.recorded_m = {one.x_m, one.y_m, one.z_m};
    placed.depth_m = -place_enu_m.z();
    const double height_m = ping.pose.ellipsoid_height_m;
    placed.height_m = height_m == 0.0 ? std::numeric_limits<double>::quiet_NaN() : height_m - placed.place_m.z();
    // From the reference point where the ping's own datagram has it.
    const frames::Geodetic stated{ping.pose.latitude_deg, ping.pose.longitude_deg};
    const frames::Vec2 reference =
        Fixes::is_known(stated) ? fixes_.projection().enu_of(stated) : frames::Vec2(body.position_enu_m.head<2>());
    put_on_map(fixes_.projection(), body, reference, place_enu_m, placed);
    return placed;
  }

  const std::string& file_;
  const Trace& trace_;
  std::optional<Vessel> vessel_;
  std::map<std::int64_t, Knots> profiles_;  // by the time from which they are in force
  Fixes fixes_;
  Track track_;
};

}  // namespace

Summary place_kmall(const std::string& file, const Trace& trace, const TakePlaced& take) {
  return File(file, trace).place(take);
}

}  // namespace ensonify::survey_files
