#pragma once

#include <span>
#include <vector>

#include "components/formats/kmall/soundings.h"
#include "components/logger/format.h"
#include "components/logger/ping_place.h"
#include "components/logger/vessel.h"

/// What #MRZ says of a ping as a whole.
namespace ensonify::logger::kmall {

/// But for height and image.
formats::kmall::PingPose ping_pose(const LoggedSoundings& ping, const Vessel& vessel, const PingPlace& place);

/// With the coverage that the soundings have.
formats::kmall::PingInfo ping_info(const msg::Soundings& soundings, std::span<const formats::kmall::Sounding> written);

std::vector<formats::kmall::Soundings::Sector> sectors(const msg::AppliedSettings& settings);

}  // namespace ensonify::logger::kmall
