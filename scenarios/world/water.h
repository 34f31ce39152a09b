#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/config/parameters.h"
#include "kernels/water/absorption.h"
#include "kernels/water/column.h"
#include "kernels/water/sound_speed.h"

namespace ensonify {

/// Limits of what a sample may hold, in a file and in a scenario alike.
namespace sample_limits {
inline constexpr double kDeepest_m = 12000.0, kSlowest_mps = 1300.0, kFastest_mps = 1700.0, kColdest_degc = -2.0,
                        kWarmest_degc = 40.0, kSaltiest_psu = 45.0;
}

/// The water at one depth, as a cast or the scenario's author gives it: a sound speed, or temperature and salinity, or
/// all of them.
struct WaterSample {
  double depth_m = 0.0;
  std::optional<double> sound_speed_mps;
  std::optional<double> temperature_degc;
  std::optional<double> salinity_psu;

  static void parameters(auto& self, auto&& visit) {
    using namespace sample_limits;
    visit("depth_m", "m", must(in(0, kDeepest_m)), "depth below chart datum; depths rise", self.depth_m);
    visit("sound_speed_mps", "m/s", in(kSlowest_mps, kFastest_mps), "left out: computed from the other two",
          self.sound_speed_mps);
    visit("temperature_degc", "degC", in(kColdest_degc, kWarmest_degc), "temperature there", self.temperature_degc);
    visit("salinity_psu", "psu", in(0, kSaltiest_psu), "salinity there", self.salinity_psu);
  }
  void check(const ConfigReader& from) const;
};

/// A sound speed profile: the same speed everywhere, or samples with depths rising.
struct WaterProfile {
  std::optional<double> sound_speed_mps;
  std::vector<WaterSample> samples;

  bool given() const { return sound_speed_mps.has_value() || !samples.empty(); }
};

/// The water. What follows from it for a head is in components/sonar/environment.h.
struct Water {
  double temperature_degc = 10.0;
  double salinity_psu = 35.0;
  double ph = 8.0;
  /// Not given: one speed everywhere, of temperature and salinity at the mission's depth.
  WaterProfile profile;
  /// The profile of those who correct soundings for refraction. Not given: they know the true profile.
  WaterProfile applied;
  water::SoundSpeedLaw sound_speed_law = water::SoundSpeedLaw::kMackenzie;
  water::AbsorptionLaw absorption_law = water::AbsorptionLaw::kFrancoisGarrison;
  std::optional<double> absorption_dbpm;  // dB/m
  double wind_speed_mps = 0.0;
  std::optional<double> noise_level_db;
  std::vector<water::ScatteringLayer> scattering_layers;
  double bubble_loss_db = 0.0;

  /// What of it has one value; the rest is in WaterKeys.
  static void parameters(auto& self, auto&& visit) {
    using namespace sample_limits;
    visit("temperature_degc", "degC", in(kColdest_degc, kWarmest_degc),
          "temperature of the water where the profile has none", self.temperature_degc);
    visit("salinity_psu", "psu", in(0, kSaltiest_psu), "salinity of the water where the profile has none",
          self.salinity_psu);
    visit("ph", "", in(6, 9), "acidity, for the absorption", self.ph);
    visit("sound_speed_law", "",
          one_of({{"mackenzie", water::SoundSpeedLaw::kMackenzie},
                  {"unesco", water::SoundSpeedLaw::kUnesco},
                  {"del_grosso", water::SoundSpeedLaw::kDelGrosso}}),
          "sound speed of temperature, salinity and depth", self.sound_speed_law);
    visit("absorption_law", "",
          one_of({{"francois_garrison", water::AbsorptionLaw::kFrancoisGarrison},
                  {"ainslie_mccolm", water::AbsorptionLaw::kAinslieMcColm}}),
          "absorption at a head's frequency", self.absorption_law);
    visit("absorption_db_per_km", "dB/km", in(0, 2000), "absorption instead of the law", self.absorption_dbpm);
    visit("wind_speed_mps", "m/s", in(0, 40), "wind 10 m above the sea: its noise, the surface's roughness and bubbles",
          self.wind_speed_mps);
    visit("noise_level_db", "dB", in(-100, 200),
          "noise re 1 uPa^2/Hz, omnidirectional, instead of thermal and wind noise", self.noise_level_db);
    visit("bubble_loss_db", "dB", in(0, 60), "loss one way, by bubbles under the hull", self.bubble_loss_db);
  }
};

}  // namespace ensonify
