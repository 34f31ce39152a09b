#pragma once

#include <cstdint>

#include "kernels/random/stream.h"
#include "kernels/terrain/tile.h"

namespace ensonify::terrain {

/// A ridge: Gaussian across, level along its line, falling off as a Gaussian of the same width beyond its ends.
struct Ridge {
  Vec2 start_enu_m = Vec2::Zero();
  Vec2 end_enu_m = Vec2::Zero();
  double height_m = 0.0;  // above the slope; 0 is no ridge
  double width_m = 20.0;  // > 0, full width at half height
};

/// Boulders: half ellipsoids strewn at random, at most one per square cell of 2 * largest_radius_m.
struct Boulders {
  double per_hectare = 0.0;  // expected number; at most one per cell limits it
  double smallest_radius_m = 0.5;
  double largest_radius_m = 2.0;
  double height_per_radius = 0.8;
};

/// Fractal relief: octaves of gradient noise [Perlin2002] whose amplitudes fall as wavelength^hurst.
struct Relief {
  double rms_m = 0.0;  // 0 is none
  double longest_wavelength_m = 40.0;
  int octaves = 5;       // each half as long as the one before
  double hurst = 0.625;  // relief spectrum exponent 3.25 [APL1994] = 2 H + 2
};

struct SyntheticSeabedParameters {
  std::uint64_t seed = 0;
  Vec2 reference_enu_m = Vec2::Zero();
  double reference_depth_m = 20.0;    // at the reference, positive down
  double slope_rad = 0.0;             // of the base plane
  double downhill_heading_rad = 0.0;  // grid heading in which it gets deeper
  Ridge ridge;
  Boulders boulders;
  Relief relief;
};

/// Classes that a synthetic seabed assigns.
enum class Sediment : std::uint8_t { kBase = 0, kRidge = 1, kBoulder = 2 };

/// A seabed as a function of place: a sloping plane, a ridge, boulders and low relief, summed. The value at a place
/// depends on the parameters and that place only, so tiles can be made in any order.
class SyntheticSeabed {
 public:
  explicit SyntheticSeabed(const SyntheticSeabedParameters& parameters);

  /// ENU z, m, positive up (so it is negative).
  double height_m(double x_enu_m, double y_enu_m) const;

  /// kRidge where the ridge stands above half its height, kBoulder on boulders, else kBase.
  Sediment sediment(double x_enu_m, double y_enu_m) const;

  const SyntheticSeabedParameters& parameters() const { return parameters_; }

 private:
  double ridge_m(const Vec2& place) const;
  double boulder_m(const Vec2& place) const;
  double relief_m(const Vec2& place) const;

  SyntheticSeabedParameters parameters_;
  random::Stream boulders_;
  random::Stream relief_;
};

}  // namespace ensonify::terrain
