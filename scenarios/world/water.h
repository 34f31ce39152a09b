#pragma once

#include <optional>
#include <vector>

#include "kernels/water/absorption.h"
#include "kernels/water/sound_speed.h"
#include "kernels/water/volume.h"

namespace ensonify {

/// The water at one depth, as a cast or the scenario's author gives it: a sound speed, or temperature and salinity, or
/// all of them.
struct WaterSample {
  double depth_m = 0.0;                   // positive down
  std::optional<double> sound_speed_mps;  // not given: computed from the other two
  std::optional<double> temperature_degc;
  std::optional<double> salinity_psu;
};

/// A sound speed profile: the same speed everywhere, or samples with depths rising.
struct WaterProfile {
  std::optional<double> sound_speed_mps;
  std::vector<WaterSample> samples;

  bool given() const { return sound_speed_mps.has_value() || !samples.empty(); }
};

/// The water. What follows from it for a head is in components/sonar/environment.h.
struct Water {
  double temperature_degc = 10.0;  // where the profile has none
  double salinity_psu = 35.0;      // where the profile has none
  double ph = 8.0;
  /// Not given: one speed everywhere, of temperature and salinity at the mission's depth.
  WaterProfile profile;
  /// The profile of those who correct soundings for refraction. Not given: they know the true profile.
  WaterProfile applied;
  water::SoundSpeedLaw sound_speed_law = water::SoundSpeedLaw::kMackenzie;
  water::AbsorptionLaw absorption_law = water::AbsorptionLaw::kFrancoisGarrison;
  std::optional<double> absorption_dbpm;  // dB/m; not given: computed for each head's frequency
  double wind_speed_mps = 0.0;            // 10 m above the sea
  std::optional<double> noise_level_db;   // re 1 uPa^2/Hz, omnidirectional; not given: thermal and wind noise
  std::vector<water::ScatteringLayer> scattering_layers;
  double bubble_loss_db = 0.0;  // one way, by bubbles under the hull
};

}  // namespace ensonify
