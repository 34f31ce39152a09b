#include "kernels/water/sound_speed.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace ensonify::water;
using Catch::Matchers::WithinAbs;

namespace {
constexpr SoundSpeedLaw kLaws[] = {SoundSpeedLaw::kMackenzie, SoundSpeedLaw::kUnesco, SoundSpeedLaw::kDelGrosso};
constexpr double kBar = 1e5;  // Pa
double t90(double t68) { return t68 / 1.00024; }
}  // namespace

TEST_CASE("sound speed matches the published check values to the printed digit") {
  CHECK_THAT(sound_speed_mps(25.0, 35.0, 1000.0), WithinAbs(1550.744, 5e-4));  // [Mackenzie1981]
  CHECK_THAT(unesco_sound_speed_mps(0, 35, 0), WithinAbs(1449.139, 5e-4));
  CHECK_THAT(unesco_sound_speed_mps(20, 35, 500 * kBar), WithinAbs(1604.492, 5e-4));
  CHECK_THAT(del_grosso_sound_speed_mps(0, 35, 0), WithinAbs(1449.083, 5e-4));
}

TEST_CASE("the coefficients of 1995 give what those of 1983 gave") {
  // [Fofonoff1983] p. 48, on the temperature scale of 1968. Its coefficients give 1731.9954 here, those of
  // [WongZhu1995], fitted anew for the scale of 1990 and printed with as many digits, 1732.0037: at the warm, deep,
  // salty end of the range.
  CHECK_THAT(unesco_sound_speed_mps(t90(40), 40, 1000 * kBar), WithinAbs(1731.995, 9e-3));
}

TEST_CASE("the table of UNESCO 44 is matched to its printed digit") {
  // [Fofonoff1983] p. 50, m/s, rounded to 0.1; temperature by the scale of 1968, and 2 mm/s for the refit.
  struct Row {
    double salinity_psu, pressure_bar;
    double speed_mps[5];  // at 0, 10, 20, 30, 40 degC
  };
  const Row rows[] = {
      {25, 0, {1435.8, 1477.7, 1510.3, 1535.2, 1553.4}},   {25, 100, {1452.0, 1494.1, 1527.0, 1552.1, 1570.6}},
      {25, 500, {1520.4, 1561.3, 1593.6, 1619.0, 1638.0}}, {25, 1000, {1610.4, 1647.4, 1676.8, 1700.6, 1719.2}},
      {30, 0, {1442.5, 1483.7, 1515.9, 1540.4, 1558.3}},   {30, 100, {1458.8, 1500.2, 1532.5, 1557.3, 1575.4}},
      {30, 500, {1527.2, 1567.4, 1599.1, 1624.0, 1642.7}}, {30, 1000, {1616.8, 1653.3, 1682.1, 1705.4, 1723.5}},
      {35, 0, {1449.1, 1489.8, 1521.5, 1545.6, 1563.2}},   {35, 100, {1465.5, 1506.3, 1538.1, 1562.4, 1580.2}},
      {35, 500, {1534.0, 1573.4, 1604.5, 1629.0, 1647.3}}, {35, 1000, {1623.2, 1659.0, 1687.2, 1710.1, 1727.8}},
      {40, 0, {1455.8, 1495.9, 1527.1, 1550.8, 1568.1}},   {40, 100, {1472.3, 1512.5, 1543.7, 1567.6, 1585.0}},
      {40, 500, {1540.7, 1579.4, 1609.8, 1633.9, 1651.9}}, {40, 1000, {1629.3, 1664.6, 1692.2, 1714.6, 1732.0}}};
  for (const Row& row : rows) {
    for (int i = 0; i < 5; ++i) {
      const double speed_mps = unesco_sound_speed_mps(t90(10.0 * i), row.salinity_psu, row.pressure_bar * kBar);
      CHECK_THAT(speed_mps, WithinAbs(row.speed_mps[i], 0.052));
    }
  }
}

TEST_CASE("the laws agree with the equation of state of 2010 within their errors") {
  // Speeds by the Gibbs function of [TEOS10], the example of its gsw_sound_speed_t_exact. Its form is
  // independent of these fits, its sources include Del Grosso's data: his fit is within its 0.05 m/s; Mackenzie's and
  // Chen-Millero's are within 1.6 standard errors of 0.07 and 0.19 m/s.
  struct Sample {
    double absolute_salinity, temperature_degc, pressure_dbar, speed_mps;
  };
  const Sample samples[] = {{34.7118, 28.7856, 10, 1542.6158},  {34.8915, 28.4329, 50, 1542.7035},
                            {35.0256, 22.8103, 125, 1530.8450}, {34.8472, 10.2600, 250, 1494.4100},
                            {34.7366, 6.8863, 600, 1487.3771},  {34.7324, 4.4036, 1000, 1483.9346}};
  for (const Sample& sample : samples) {
    const double T = sample.temperature_degc;
    const double S = sample.absolute_salinity * 35.0 / 35.16504;
    const double pressure_pa = sample.pressure_dbar * 1e4;
    CHECK_THAT(del_grosso_sound_speed_mps(T, S, pressure_pa), WithinAbs(sample.speed_mps, 0.05));
    CHECK_THAT(unesco_sound_speed_mps(T, S, pressure_pa), WithinAbs(sample.speed_mps, 1.6 * 0.19));
    double depth_m = 0.0;
    while (sea_pressure_pa(depth_m, kMeanLatitude_rad) < pressure_pa) depth_m += 0.1;
    CHECK_THAT(sound_speed_mps(T, S, depth_m), WithinAbs(sample.speed_mps, 1.6 * 0.07));
  }
}

TEST_CASE("pressure at depth matches the published check values") {
  const double latitude_rad = std::numbers::pi / 6;
  // [Saunders1981]: 7500.004 dbar at 7321.45 m, 30 degrees; half a centimetre of printed depth is 0.005 dbar.
  CHECK_THAT(sea_pressure_pa(7321.45, latitude_rad) / 1e4, WithinAbs(7500.004, 5e-3));
  // The longer formula of [Fofonoff1983] p. 28 puts 10000 dbar at 9712.653 m; Saunders's own is within 0.07 % of it.
  CHECK(sea_pressure_pa(9712.653, latitude_rad) / 1e4 == Approx(10000.0).epsilon(7e-4));
  CHECK(sea_pressure_pa(0, latitude_rad) == 0.0);
}

TEST_CASE("the three laws agree where all were made for it") {
  // In cold water at depth Chen-Millero lies some tenths of a m/s above Del Grosso, and travel times across oceans say
  // that it is the one in error [SpiesbergerMetzger1991].
  for (const double depth_m : {0.0, 100.0, 1000.0, 3000.0}) {
    for (const double t : {2.0, 4.0, 10.0}) {
      const double mackenzie = sound_speed_mps(SoundSpeedLaw::kMackenzie, t, 35, depth_m);
      CHECK_THAT(sound_speed_mps(SoundSpeedLaw::kUnesco, t, 35, depth_m), WithinAbs(mackenzie, 0.7));
      CHECK_THAT(sound_speed_mps(SoundSpeedLaw::kDelGrosso, t, 35, depth_m), WithinAbs(mackenzie, 0.7));
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
  CHECK_THAT(at(SoundSpeedLaw::kUnesco, 90) - at(SoundSpeedLaw::kUnesco, 0), WithinAbs(0.36, 0.03));
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
