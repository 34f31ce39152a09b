#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "kernels/vehicle/motion/sampled_curve.h"

/// References of heights, and the water level. World zero is chart datum; all heights are up.
namespace ensonify::vertical {

/// A height that changes, and its derivatives.
struct Level {
  double height_m = 0.0;
  double rate_mps = 0.0;
  double acceleration_mps2 = 0.0;
};

/// Speed of a tidal constituent in degrees per hour, by its usual name (M2, S2, N2, K1, ...), from the published list
/// of [NTSLF; NOAA]; nothing for a name that is not in it. Speeds follow from the astronomy of sun and moon and hold
/// everywhere [Schureman1958].
std::optional<double> constituent_speed_degph(std::string_view name);
/// The names that constituent_speed_degph knows, with commas, for messages.
std::string_view constituent_names();

/// One constituent at one place.
struct Constituent {
  double speed_radps = 0.0;
  double amplitude_m = 0.0;  // with the nodal factor of the year, f H
  double phase_rad = 0.0;    // by which high water lags the reference time: kappa - (V0 + u) then
};

/// A sum of constituents about a mean level; NOAA's h = H0 + sum f H cos(a t + (V0 + u) - kappa).
struct HarmonicTide {
  double mean_m = 0.0;  // above chart datum
  std::vector<Constituent> constituents;
};

/// Levels that a gauge read; times rise. In between a motion::SampledCurve, through the readings: level and rate
/// are continuous, and the acceleration is that of the piece. Before the first reading that one stands; behind the last
/// the level comes to rest on it in the time of the last interval, and stands.
struct GaugeReadings {
  std::vector<std::pair<double, double>> time_s_and_height_m;
};

/// The tide above chart datum.
class Tide {
 public:
  Tide() : Tide(0.0) {}
  explicit Tide(double constant_m) : kind_(constant_m) {}
  explicit Tide(HarmonicTide harmonic) : kind_(std::move(harmonic)) {}
  /// Throws std::invalid_argument without readings, or when their times do not rise.
  explicit Tide(GaugeReadings readings);

  /// At sim time t, exact, with its derivatives.
  Level at(double t_s) const;

  /// The time that the tide is known for: all of it but for readings.
  double first_s() const;
  double last_s() const;

 private:
  struct Gauge {
    motion::SampledCurve level;
    double to_rest_s = 0.0;  // behind the last reading
  };
  std::variant<double, HarmonicTide, Gauge> kind_;
};

}  // namespace ensonify::vertical
