#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "components/errors/exit_error.h"
#include "components/formats/all/reader.h"
#include "components/survey_files/survey_file.h"

namespace ensonify::survey_files {
namespace {

using namespace formats::all;
using frames::Vec3;
using Knots = std::vector<refraction::Knot>;

/// A .all file, read twice: what holds at a time first, then its pings. Angles and times come before the soundings that
/// were made of them.
class File {
 public:
  File(const std::string& file, const Trace& trace) : file_(file), trace_(trace) {
    std::vector<Moved> active, passive;
    Fixes of_others;  // systems than the active one
    each_datagram<Reader>(file_, [&](const Datagram& datagram) {
      if (const auto* text = std::get_if<Installation>(&datagram.body); text != nullptr && !vessel_) {
        vessel_ = vessel_of_all(file_, text->text, datagram.header.model);
        second_serial_ = text->secondary_serial;
      }
      if (const auto* profile = std::get_if<SoundSpeedProfile>(&datagram.body))
        profiles_[datagram.unix_ns()] = knots_of(*profile);
      if (const auto* position = std::get_if<Position>(&datagram.body))
        ((position->descriptor & 0x80U) != 0 ? fixes_ : of_others)
            .add(datagram.unix_ns(), {position->latitude_deg.value(), position->longitude_deg.value()});
      if (const auto* attitude = std::get_if<Attitude>(&datagram.body))
        add(*attitude, datagram.unix_ns(), is_active(*attitude) ? active : passive);
    });
    if (!vessel_) throw UserError(file_ + ": holds no installation (I)");
    if (profiles_.empty()) throw UserError(file_ + ": holds no sound speed profile (U)");
    if (active.empty()) active = std::move(passive);
    if (active.empty()) throw UserError(file_ + ": holds no attitude (A)");
    if (fixes_.empty()) fixes_ = std::move(of_others);
    if (fixes_.empty()) throw UserError(file_ + ": holds no position (P)");
    make_track(active);
  }

  Summary place(const TakePlaced& take) {
    Summary summary;
    summary.faults = each_datagram<Reader>(file_, [&](const Datagram& datagram) {
      const Key key{datagram.header.counter, datagram.header.serial};
      if (const auto* raw = std::get_if<RawRangeAngle>(&datagram.body)) raw_[key] = *raw;
      const auto* soundings = std::get_if<Soundings>(&datagram.body);
      if (soundings == nullptr) return;
      const auto raw = raw_.find(key);
      if (raw != raw_.end() && raw->second.beams.size() == soundings->beams.size())
        place(datagram, raw->second, *soundings, take, summary);
      else summary.rejected += soundings->beams.size();
      if (raw != raw_.end()) raw_.erase(raw);
      if (raw_.size() > kMostWaiting) raw_.clear();
    });
    return summary;
  }

 private:
  using Key = std::pair<std::uint16_t, std::uint16_t>;  // counter, serial
  static constexpr std::size_t kMostWaiting = 16;       // pings whose soundings have not come

  /// Roll, pitch and heave of it count.
  static bool is_active(const Attitude& attitude) { return (attitude.descriptor & 0x0EU) == 0; }

  static void add(const Attitude& attitude, std::int64_t unix_ns, std::vector<Moved>& to) {
    constexpr std::int64_t kMillisecond_ns = 1'000'000;
    for (const Attitude::Entry& entry : attitude.entries)
      to.push_back({unix_ns + entry.after_ms * kMillisecond_ns, static_cast<float>(entry.roll_deg.value()),
                    static_cast<float>(entry.pitch_deg.value()), static_cast<float>(entry.heading_deg.value()),
                    static_cast<float>(entry.heave_m.value())});
  }

  Knots knots_of(const SoundSpeedProfile& profile) const {
    Knots knots;
    for (const auto& node : profile.nodes) add_node(file_, profile.depth_m(node), node.sound_speed_mps.value(), knots);
    if (knots.empty()) throw UserError(file_ + ": its profile has no node");
    return knots;
  }

  /// Heights of the reference point count from the water line. Attitude is that of the vessel already.
  void make_track(const std::vector<Moved>& motion) {
    const Vec3& transmitter_m = vessel_->transmitters[0].installed.position_body_m;
    for (const Moved& one : motion) {
      const double heave_m = one.heave_down_m;
      frames::Pose body;
      body.enu_from_body = frames::enu_from_ned() * turn_of(one.roll_deg, one.pitch_deg, one.heading_deg);
      const Vec3 origin_enu_m = body.enu_from_body * vessel_->origin_m;  // of fixes
      body.position_enu_m.head<2>() = fixes_.enu_at(one.unix_ns) - origin_enu_m.head<2>();
      if (vessel_->heave_at_transmitter) {
        const double depth_m = transmitter_m.z() - vessel_->water_line_m + heave_m;  // of the transmitter
        body.position_enu_m.z() = -depth_m - (body.enu_from_body * transmitter_m).z();
      } else {
        body.position_enu_m.z() = vessel_->water_line_m - heave_m;
      }
      track_.add(one.unix_ns, body);
    }
    track_.sort();
  }

  void place(const Datagram& datagram, const RawRangeAngle& raw, const Soundings& soundings, const TakePlaced& take,
             Summary& summary) const {
    ++summary.pings;
    const std::int64_t unix_ns = datagram.unix_ns();
    const bool second = vessel_->receivers.size() > 1 && datagram.header.serial == second_serial_;
    const auto body = track_.at(unix_ns);
    const auto moving = track_.moving_at(unix_ns);
    std::optional<Water> water;
    if (body) water = water_of(datagram, soundings);
    for (std::size_t i = 0; i < soundings.beams.size(); ++i) {
      const RawRangeAngle::Beam& beam = raw.beams[i];
      if (!soundings.beams[i].valid() || !beam.valid() || beam.sector >= raw.sectors.size()) {
        ++summary.rejected;
        continue;
      }
      const RawRangeAngle::Sector& sector = raw.sectors[beam.sector];
      const std::size_t arrays = vessel_->transmitters[0].phase_centre_m.size();
      const Measured measured{.ping_ns = unix_ns,
                              .delay_s = static_cast<double>(sector.delay_s),
                              .two_way_s = static_cast<double>(beam.travel_time_s),
                              .tilt_rad = kDegree * sector.tilt_deg.value(),
                              .angle_rad = -kDegree * beam.angle_deg.value(),
                              .transmitter = &vessel_->transmitters[0],
                              .receiver = &vessel_->receivers[second ? 1 : 0],
                              .transmit_centre = arrays > 1 ? std::size_t{sector.index} : 0};
      const auto place = water ? place_enu_m(measured, *water, track_) : std::nullopt;
      if (!place) {
        ++summary.without_attitude;
      } else if (!place->allFinite()) {
        ++summary.rejected;
      } else {
        ++summary.soundings;
        Placed placed = placed_of(soundings, soundings.beams[i], *body, *place);
        placed.ping = datagram.header.counter;
        placed.head = second ? 1 : 0;
        placed.sounding = i;
        placed.unix_ns = unix_ns;
        placed.body = moving;
        placed.head_enu_m =
            frames::head_pose(*body, measured.transmitter->mounting(measured.transmit_centre)).position_enu_m;
        take(placed);
      }
    }
  }

  Water water_of(const Datagram& datagram, const Soundings& soundings) const {
    const auto profile = profiles_.upper_bound(datagram.unix_ns());
    const Knots& in_force = profile == profiles_.begin() ? profile->second : std::prev(profile)->second;
    const double depth_m = soundings.transducer_depth_m;
    if (!trace_.surface_speed) return water_of_profile(depth_m, in_force);
    const double speed_mps = checked_speed(file_, soundings.sound_speed_mps.value(),
                                           fmt::format("ping {} at the transducer", datagram.header.counter));
    return water_below(depth_m, speed_mps, in_force);
  }

  Placed placed_of(const Soundings& soundings, const Soundings::Beam& beam, const frames::Pose& body,
                   const Vec3& place_enu_m) const {
    const frames::Quaternion level = level_from_enu(body);
    const Vec3 origin_m = level * (body.enu_from_body * vessel_->origin_m);  // of its x and y
    const double depth_m = static_cast<double>(beam.z_m) + static_cast<double>(soundings.transducer_depth_m);
    Placed placed;
    placed.place_m = level * (place_enu_m - body.position_enu_m);
    placed.recorded_m = {origin_m.x() + static_cast<double>(beam.x_m), origin_m.y() + static_cast<double>(beam.y_m),
                         depth_m + body.position_enu_m.z()};
    placed.depth_m = -place_enu_m.z();
    placed.height_m = std::numeric_limits<double>::quiet_NaN();
    put_on_map(fixes_.projection(), body, frames::Vec2(body.position_enu_m.head<2>()), place_enu_m, placed);
    return placed;
  }

  const std::string& file_;
  const Trace& trace_;
  std::optional<VesselOfAll> vessel_;
  std::uint16_t second_serial_ = 0;
  std::map<std::int64_t, Knots> profiles_;  // by the time from which they are in force
  Fixes fixes_;
  Track track_;
  std::map<Key, RawRangeAngle> raw_;  // of pings whose soundings are yet to come
};

}  // namespace

Summary place_all(const std::string& file, const Trace& trace, const TakePlaced& take) {
  return File(file, trace).place(take);
}

}  // namespace ensonify::survey_files
