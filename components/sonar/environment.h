#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernels/seabed/table.h"
#include "kernels/water/column.h"
#include "kernels/water/refraction/profile.h"
#include "scenarios/world/world.h"

namespace ensonify {

/// Speed of sound over depth as it truly is. Without a profile in the scenario: the same everywhere, as given or of the
/// scenario's temperature and salinity at the mission's depth. Samples that change the speed by less than 0.01 m/s are
/// left out: each would cost each ray a step.
refraction::SoundSpeedProfile true_profile(const World& world);

/// The profile that soundings are corrected with: `water.applied`, else the true one.
refraction::SoundSpeedProfile applied_profile(const World& world);

/// Temperature and salinity over depth, as they truly are: beyond the scenario's samples they stay the same.
water::Column true_column(const Water& water);

/// Water, surface and seabed as a head of one frequency has them: what every head has from the scenario besides its
/// mounting. Depths are positive down from chart datum; water above that is as it is there, without scattering layers.
class Environment {
 public:
  Environment(const World& world, double frequency_hz);

  const refraction::SoundSpeedProfile& profile() const { return profile_; }          // the true one
  const refraction::SoundSpeedProfile& applied_profile() const { return applied_; }  // what the instrument applies

  /// Absorption in dB/m: averaged over the depths between the ends of a path, so what a straight path between them
  /// has whatever its slope, and a refracted one nearly. `water.absorption_db_per_km` where that is given.
  double absorption_dbpm(double from_depth_m, double to_depth_m) const;

  /// Noise as an omnidirectional receiver receives it, dB re 1 uPa^2/Hz: thermal and wind noise, or
  /// `water.noise_level_db`.
  double noise_level_db() const { return noise_level_db_; }

  /// Backscattering cross section of the seabed per unit area by class of the post and grazing angle. The sediments'
  /// laws are made for the speed of sound at the profile's last sample.
  const seabed::ClassTables& backscatter() const { return *backscatter_; }

  /// Memory of the laws of facets: its contents do not matter.
  struct FacetLaws {
    std::shared_ptr<const seabed::ClassTables> of;  // laws that are these on a plane
    std::vector<double> mean_square_slope;          // by class
    std::optional<seabed::ClassTables> tables;
  };
  /// The same of the facets of a mesh of these slopes (trace::Scene), in the memory unless they are none. Tables are
  /// made where the slopes are not those of the memory.
  const seabed::ClassTables& backscatter(std::span<const double> mean_square_slope, FacetLaws& memory) const;

  /// The sea surface above chart datum, m, at sim time t.
  double water_level_m(double t_s) const { return tide_.at(t_s).height_m; }
  /// Rms height of a fully developed sea of that wind: what roughens the mirror of the surface
  /// (surface::coherent_reflection). The scenario's wind, 10 m above the sea, stands for that at 19.5 m, which makes
  /// waves 5 % too low.
  double rms_wave_height_m() const { return rms_wave_height_m_; }

  /// For water::volume_scattering_db; empty: the water does not scatter.
  const std::vector<water::ScatteringLayer>& scattering_layers() const { return scattering_layers_; }
  /// One way, by bubbles under the hull: an echo loses it twice.
  double bubble_loss_db() const { return bubble_loss_db_; }

 private:
  double frequency_hz_;
  refraction::SoundSpeedProfile profile_, applied_;
  water::Column column_;
  water::AbsorptionLaw absorption_law_;
  std::optional<double> absorption_dbpm_;
  double noise_level_db_;
  std::map<std::uint8_t, seabed::Scatterer> sediments_;  // on a plane, or as the scenario says
  std::shared_ptr<const seabed::ClassTables> backscatter_;
  vertical::Tide tide_;
  double rms_wave_height_m_;
  std::vector<water::ScatteringLayer> scattering_layers_;
  double bubble_loss_db_;
};

}  // namespace ensonify
