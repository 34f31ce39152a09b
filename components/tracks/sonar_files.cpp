// Navigation and attitude of .all, .kmall and XTF files.
#include <algorithm>
#include <cmath>
#include <optional>

#include "components/formats/all/reader.h"
#include "components/formats/kmall/reader.h"
#include "components/formats/xtf/reader.h"
#include "components/survey_files/fixes.h"
#include "components/survey_files/vessel.h"
#include "components/tracks/readers.h"
#include "kernels/base/frames/attitude.h"

namespace ensonify::tracks {
namespace {

/// What a motion sensor said, of the vessel.
struct Moved {
  std::int64_t ns;
  double heading_rad, pitch_rad, roll_rad, heave_m;

  bool finite() const { return std::isfinite(heading_rad + pitch_rad + roll_rad + heave_m); }
};

/// In the order of their times, each time once. Datagrams of several systems stand in a file as they came in.
template <class One>
void put_in_order(std::vector<One>& of) {
  std::ranges::stable_sort(of, {}, &One::ns);
  of.erase(std::unique(of.begin(), of.end(), [](const One& a, const One& b) { return a.ns == b.ns; }), of.end());
}

Track track_of(const std::string& file, std::vector<Fix> fixes, std::vector<Moved> motion, const char* position) {
  std::erase_if(fixes, [](const Fix& fix) { return !survey_files::Fixes::is_known(fix.place); });
  std::erase_if(motion, [](const Moved& one) { return !one.finite(); });
  if (fixes.empty()) throw UserError(fmt::format("{}: holds no position ({})", file, position));
  put_in_order(fixes);
  put_in_order(motion);
  Track track;
  track.file = file;
  track.fixes = std::move(fixes);
  for (const Moved& one : motion) {
    track.heading_rad.push_back({one.ns, one.heading_rad});
    track.pitch_rad.push_back({one.ns, one.pitch_rad});
    track.roll_rad.push_back({one.ns, one.roll_rad});
    track.heave_m.push_back({one.ns, one.heave_m});
  }
  return track;
}

template <class Reader, class See>
void each(const std::string& file, const See& see) {
  formats::Window window(file);
  Reader reader(window);
  while (const auto datagram = reader.next()) see(*datagram);
}

}  // namespace

/// Positions of the active system, and attitude of the sensor that counts: it is the vessel's already.
Track read_all(const std::string& file) {
  using namespace formats::all;
  std::vector<Fix> active, of_others;
  std::vector<Moved> counting, other;
  each<Reader>(file, [&](const Datagram& datagram) {
    if (const auto* position = std::get_if<Position>(&datagram.body)) {
      ((position->descriptor & 0x80U) != 0 ? active : of_others)
          .push_back({datagram.unix_ns(), {position->latitude_deg.value(), position->longitude_deg.value()}});
    }
    const auto* attitude = std::get_if<Attitude>(&datagram.body);
    if (attitude == nullptr) return;
    for (const Attitude::Entry& entry : attitude->entries) {
      ((attitude->descriptor & 0x0EU) == 0 ? counting : other)
          .push_back({datagram.unix_ns() + entry.after_ms * std::int64_t{1'000'000},
                      kDegree * entry.heading_deg.value(), kDegree * entry.pitch_deg.value(),
                      kDegree * entry.roll_deg.value(), -entry.heave_m.value()});
    }
  });
  return track_of(file, active.empty() ? of_others : active, counting.empty() ? other : counting, "P");
}

/// Positions of the active system, of the vessel's reference point; attitude turned from the sensor to the vessel.
Track read_kmall(const std::string& file) {
  using namespace formats::kmall;
  std::vector<Fix> active, of_others;
  std::vector<Moved> motion;
  std::optional<survey_files::Vessel> vessel;
  each<Reader>(file, [&](const Datagram& datagram) {
    if (const auto* text = std::get_if<Installation>(&datagram.body); text != nullptr && !vessel)
      vessel = survey_files::vessel_of_kmall(file, text->text);
    if (const auto* position = std::get_if<Position>(&datagram.body)) {
      ((position->sensor.status & 1U) != 0 ? active : of_others)
          .push_back({datagram.unix_ns(), {position->latitude_deg, position->longitude_deg}});
    }
    const auto* samples = std::get_if<Motion>(&datagram.body);
    if (samples == nullptr || !vessel || samples->sensor != vessel->motion_sensor) return;
    for (const Motion::Sample& sample : samples->samples) {
      const frames::Attitude of_sensor{.heading_rad = kDegree * static_cast<double>(sample.heading_deg),
                                       .pitch_rad = kDegree * static_cast<double>(sample.pitch_deg),
                                       .roll_rad = kDegree * static_cast<double>(sample.roll_deg)};
      const frames::Attitude attitude =
          frames::attitude_of(frames::enu_from_body(of_sensor) * vessel->body_from_motion_sensor.conjugate());
      motion.push_back({std::int64_t{sample.time_s} * 1'000'000'000 + sample.time_ns, attitude.heading_rad,
                        attitude.pitch_rad, attitude.roll_rad, -static_cast<double>(sample.heave_m)});
    }
  });
  return track_of(file, active.empty() ? of_others : active, motion, "#SPO");
}

/// Positions and attitude of their own packets where there are any, else those of pings.
Track read_xtf(const std::string& file) {
  using namespace formats::xtf;
  formats::Window window(file);
  Reader reader(window);
  if (reader.header() && reader.header()->navigation_units != 3)
    throw UserError(file + ": its positions are projected metres; allowed: latitude and longitude");
  std::vector<Fix> fixes, of_pings;
  std::vector<Moved> motion, motion_of_pings;
  std::vector<Value> depths;
  const auto moved = [](std::int64_t ns, const auto& of) {
    return Moved{ns, kDegree * static_cast<double>(of.heading_deg), kDegree * static_cast<double>(of.pitch_deg),
                 kDegree * static_cast<double>(of.roll_deg), static_cast<double>(of.heave_m)};
  };
  const auto of_ping = [&](std::int64_t ns, const PingHeader& header) {
    const bool of_sensor = header.sensor_x != 0.0 || header.sensor_y != 0.0;
    of_pings.push_back({ns, of_sensor ? frames::Geodetic{header.sensor_y, header.sensor_x}
                                      : frames::Geodetic{header.ship_y, header.ship_x}});
    motion_of_pings.push_back(moved(ns, header));
    if (of_sensor) depths.push_back({ns, static_cast<double>(header.sensor_depth_m)});
  };
  while (const auto packet = reader.next()) {
    const auto ns = packet->unix_ns();
    if (!ns) continue;
    if (const auto* raw = std::get_if<RawNavigation>(&packet->body)) fixes.push_back({*ns, {raw->y, raw->x}});
    if (const auto* attitude = std::get_if<Attitude>(&packet->body)) motion.push_back(moved(*ns, *attitude));
    if (const auto* ping = std::get_if<SonarPing>(&packet->body)) of_ping(*ns, ping->header);
    if (const auto* ping = std::get_if<MultibeamPing>(&packet->body)) of_ping(*ns, ping->header);
  }
  Track track = track_of(file, fixes.empty() ? of_pings : fixes, motion.empty() ? motion_of_pings : motion,
                         "packets of navigation, or pings with one");
  const bool dives = std::ranges::any_of(depths, [](const Value& depth) { return depth.value > 0.0; });
  if (dives && fixes.empty()) {
    put_in_order(depths);
    track.depth_m = std::move(depths);
  }
  return track;
}

}  // namespace ensonify::tracks
