#include "kernels/water/sound_speed.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "kernels/water/pressure.h"

using namespace ensonify::water;

namespace {
constexpr SoundSpeedLaw kLaws[] = {SoundSpeedLaw::kMackenzie, SoundSpeedLaw::kUnesco, SoundSpeedLaw::kDelGrosso};
constexpr double kBar = 1e5;  // Pa
double t90(double t68) { return t68 / 1.00024; }
}  // namespace

TEST_CASE("sound speed matches the published check values to the printed digit") {
  CHECK(sound_speed_mps(25.0, 35.0, 1000.0) == Approx(1550.744).margin(5e-4));  // [Mackenzie1981]
  CHECK(unesco_sound_speed_mps(0, 35, 0) == Approx(1449.139).margin(5e-4));
  CHECK(unesco_sound_speed_mps(20, 35, 500 * kBar) == Approx(1604.492).margin(5e-4));
  CHECK(del_grosso_sound_speed_mps(0, 35, 0) == Approx(1449.083).margin(5e-4));
}

TEST_CASE("the coefficients of 1995 give what those of 1983 gave") {
  // [Fofonoff1983] p. 48, on the temperature scale of 1968; the refit of [WongZhu1995] moves it by less than 1 mm/s.
  CHECK(unesco_sound_speed_mps(t90(40), 40, 1000 * kBar) == Approx(1731.995).margin(1.5e-3));
}

TEST_CASE("pressure at depth matches the published check values") {
  const double latitude_rad = std::numbers::pi / 6;
  // [Saunders1981]: 7500.004 dbar at 7321.45 m, 30 degrees; half a centimetre of printed depth is 0.005 dbar.
  CHECK(sea_pressure_pa(7321.45, latitude_rad) / 1e4 == Approx(7500.004).margin(5e-3));
  // The longer formula of [Fofonoff1983] p. 28 puts 10000 dbar at 9712.653 m; Saunders's own is within 0.07 % of it.
  CHECK(sea_pressure_pa(9712.653, latitude_rad) / 1e4 == Approx(10000.0).epsilon(7e-4));
  CHECK(sea_pressure_pa(0, latitude_rad) == 0.0);
}

TEST_CASE("the three laws agree where all were made for it") {
  // 0.6 m/s: the largest published difference between Chen-Millero and Del Grosso in the upper 3 km is about that.
  for (const double depth_m : {0.0, 100.0, 1000.0, 3000.0}) {
    for (const double t : {2.0, 4.0, 10.0}) {
      const double mackenzie = sound_speed_mps(SoundSpeedLaw::kMackenzie, t, 35, depth_m);
      CHECK(sound_speed_mps(SoundSpeedLaw::kUnesco, t, 35, depth_m) == Approx(mackenzie).margin(0.7));
      CHECK(sound_speed_mps(SoundSpeedLaw::kDelGrosso, t, 35, depth_m) == Approx(mackenzie).margin(0.7));
    }
  }
}

TEST_CASE("sound speed rises with depth in isothermal water, and with warmth and salt") {
  for (const SoundSpeedLaw law : kLaws) {
    for (double depth = 0; depth < 8000; depth += 500) {
      CHECK(sound_speed_mps(law, 10, 35, depth + 500) > sound_speed_mps(law, 10, 35, depth));
    }
    CHECK(sound_speed_mps(law, 11, 35, 0) > sound_speed_mps(law, 10, 35, 0));
    CHECK(sound_speed_mps(law, 10, 36, 0) > sound_speed_mps(law, 10, 35, 0));
  }
}

TEST_CASE("latitude matters through pressure") {
  const auto at = [](SoundSpeedLaw law, double latitude_deg) {
    return sound_speed_mps(law, 4, 35, 4000, latitude_deg * std::numbers::pi / 180);
  };
  // 0.53 % of gravity from the equator to the pole: 21 m of 4000 m, at 0.0165 m/s per m.
  CHECK(at(SoundSpeedLaw::kUnesco, 90) - at(SoundSpeedLaw::kUnesco, 0) == Approx(0.36).margin(0.03));
  CHECK(at(SoundSpeedLaw::kDelGrosso, -60) == at(SoundSpeedLaw::kDelGrosso, 60));
  CHECK(at(SoundSpeedLaw::kMackenzie, 90) == at(SoundSpeedLaw::kMackenzie, 0));
}

TEST_CASE("the range of each fit is known") {
  CHECK(in_range(SoundSpeedLaw::kMackenzie, 2, 25, 0));
  CHECK_FALSE(in_range(SoundSpeedLaw::kMackenzie, 1.9, 35, 0));
  CHECK_FALSE(in_range(SoundSpeedLaw::kMackenzie, 10, 41, 0));
  CHECK_FALSE(in_range(SoundSpeedLaw::kMackenzie, 10, 35, -1));
  CHECK(in_range(SoundSpeedLaw::kUnesco, 0, 0, 0));
  CHECK(in_range(SoundSpeedLaw::kUnesco, 4, 35, 9600));
  CHECK_FALSE(in_range(SoundSpeedLaw::kUnesco, 4, 35, 9800));  // 1000 bar are at about 9700 m
  CHECK_FALSE(in_range(SoundSpeedLaw::kDelGrosso, 4, 29, 0));
  CHECK_FALSE(in_range(SoundSpeedLaw::kDelGrosso, 31, 35, 0));
}
