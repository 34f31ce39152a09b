#pragma once

#include <span>
#include <vector>

#include "components/formats/kmall/soundings.h"
#include "components/logger/format.h"
#include "components/logger/vessel.h"

/// What #MRZ says of a ping as a whole.
namespace ensonify::logger::kmall {

/// Where and how a ping was made, by the estimate. Level: forward, starboard, down, of the vessel's heading.
struct PingPlace {
  frames::Pose body;
  frames::Vec3 head_enu_m;
  frames::Geodetic reference;
  double heading_deg = 0.0;  // true, 0 to 360
  frames::Quaternion level_from_enu, level_from_head;
};
PingPlace place_of(const LoggedSoundings& ping, const Vessel& vessel);

/// But for height and image.
formats::kmall::PingPose ping_pose(const LoggedSoundings& ping, const Vessel& vessel, const PingPlace& place);

/// With the coverage that the soundings have.
formats::kmall::PingInfo ping_info(const msg::Soundings& soundings, std::span<const formats::kmall::Sounding> written);

std::vector<formats::kmall::Soundings::Sector> sectors(const msg::AppliedSettings& settings);

}  // namespace ensonify::logger::kmall
