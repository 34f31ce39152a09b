#include "components/logger/kmall/ping.h"

#include "components/logger/beam_fields.h"
#include "components/logger/kmall/ping_info.h"
#include "components/logger/kmall/sounding.h"

namespace ensonify::logger::kmall {

using namespace formats::kmall;

formats::kmall::Soundings soundings(const LoggedSoundings& ping, const Vessel& vessel, double height_m) {
  const msg::Soundings& from = ping.soundings;
  const PingPlace place = place_of(ping, vessel);
  formats::kmall::Soundings written;
  written.ping.ping = static_cast<std::uint16_t>(from.ping);
  written.pose = ping_pose(ping, vessel, place);
  written.pose.ellipsoid_height_m = static_cast<float>(height_m);
  written.sectors = sectors(from.applied);
  written.main_soundings = static_cast<std::uint16_t>(from.beam_angle_rad.size());
  written.valid_main_soundings = valid_beams(from);
  written.water_column_hz = sampling_hz(from.sample_period_s);
  written.image_hz = sampling_hz(ping.image ? ping.image->sample_period_s : from.sample_period_s);
  if (ping.image) {
    written.normal_incidence_strength_db = static_cast<float>(ping.image->normal_incidence_strength_db);
    written.oblique_strength_db = static_cast<float>(ping.image->oblique_strength_db);
    written.pose.lambert_removed = ping.image->lambert_removed ? 1 : 0;
  }
  for (std::size_t i = 0; i < from.beam_angle_rad.size(); ++i) {
    written.soundings.push_back(sounding(ping, place, i));
  }
  add_image(ping, written);
  written.info = ping_info(from, written.soundings);
  return written;
}

}  // namespace ensonify::logger::kmall
