#pragma once

#include "kernels/water/column.h"
#include "kernels/water/refraction/profile.h"
#include "kernels/water/sound_speed.h"

namespace ensonify {

/// The water as it is, by depth below chart datum.
struct TrueWater {
  refraction::SoundSpeedProfile sound_speed = refraction::SoundSpeedProfile::uniform(1500.0);
  water::Column column{{water::SeaWater{}}};  // temperature and salinity
  water::SoundSpeedLaw law = water::SoundSpeedLaw::kMackenzie;
};

}  // namespace ensonify
