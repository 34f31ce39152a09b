#include "kernels/seabed/sediment.h"

#include <catch2/catch.hpp>

#include "kernels/seabed/backscatter.h"

using namespace ensonify::seabed;
using Catch::Matchers::WithinAbs;

TEST_CASE("14 named sediments, within the report's limits, are found by each name") {
  CHECK(named_sediments().size() == 14);
  for (const auto& row : named_sediments()) {
    INFO(row.name);
    CHECK(in_range(row.parameters));
    CHECK(sediment_of(row.name) == row.parameters);
  }
  CHECK(sediment_of("gravel") == sediment_of("cobble"));
  CHECK(sediment_of("silty sand") == sediment_of("fine sand"));
  CHECK_FALSE(sediment_of("porridge").has_value());
}

TEST_CASE("the grain-size route gives the rows of the report's table 2") {
  // Half a unit of the printed digits, and 1 % more where the print of w_2 was rounded from a rounded height.
  const auto check = [](const char* name, double phi) {
    INFO(name);
    const auto row = sediment_of(name).value();
    const auto computed = sediment_of_grain_size(phi);
    CHECK_THAT(computed.density_ratio, WithinAbs(row.density_ratio, 0.0006));
    CHECK_THAT(computed.sound_speed_ratio, WithinAbs(row.sound_speed_ratio, 0.00006));
    CHECK_THAT(computed.loss, WithinAbs(row.loss, 0.000006));
    CHECK(computed.volume_parameter == row.volume_parameter);
    CHECK_THAT(computed.spectral_strength_cm4, WithinAbs(row.spectral_strength_cm4, 0.0000006));
  };
  check("sandy gravel", -1.0);
  check("very coarse sand", -0.5);
  check("coarse sand", 0.5);
  check("medium sand", 1.5);
  check("fine sand", 2.5);
  check("very fine sand", 3.5);
  check("coarse silt", 4.5);
  check("medium silt", 5.5);
  check("fine silt", 6.5);
  check("silty clay", 8.0);
  check("clay", 9.0);
}

TEST_CASE("a grain size outside the fits is refused") {
  CHECK_THROWS_WITH(sediment_of_grain_size(9.5), "mean grain size 9.500000 phi: allowed is -1 to 9");
  CHECK_THROWS(sediment_of_grain_size(-1.01));
}

TEST_CASE("reflection is the impedances' at normal incidence, and total at grazing 0") {
  for (const auto& row : named_sediments()) {
    INFO(row.name);
    const auto& sediment = row.parameters;
    const double impedance = sediment.density_ratio * sediment.sound_speed_ratio;
    // The loss changes |R| at normal incidence by its square only: 5e-4 at most.
    CHECK_THAT(std::abs(reflection_coefficient(sediment, 90 * 3.14159265358979 / 180)),
               WithinAbs((impedance - 1) / (impedance + 1), 5e-4));
    CHECK(std::abs(reflection_coefficient(sediment, 0.0)) == Approx(1.0));
    CHECK_THAT(forward_loss_db(sediment, 0.0), WithinAbs(0.0, 1e-9));
  }
}

TEST_CASE("no seabed reflects more than arrives; fast ones nearly all below critical") {
  for (const auto& row : named_sediments()) {
    for (double degrees = 0.0; degrees <= 90.0; degrees += 0.5) {
      CHECK(forward_loss_db(row.parameters, degrees * 3.14159265358979 / 180) >= -1e-9);
    }
  }
  const auto rock = sediment_of("rock").value();  // critical angle acos(1/2.5) = 66 degrees
  CHECK(forward_loss_db(rock, 40 * 3.14159265358979 / 180) < 0.5);
  CHECK_THAT(forward_loss_db(rock, 90 * 3.14159265358979 / 180), WithinAbs(2.80, 0.01));  // 20 log10(7.25 / 5.25)
}
