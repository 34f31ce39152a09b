#include "kernels/seabed/table.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace ensonify::seabed;
using Catch::WithinAbs;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kNothing = 1e-10;  // -100 dB: the header's floor

/// Greatest difference to the law, in dB, over 0-90 degrees: an even grid, and just beside every node of the table.
double greatest_error_db(const BackscatterTable& table, const Law& law) {
  double greatest = 0.0;
  const auto compare = [&](double grazing_rad) {
    // The law is asked at the very sine that the table gets: near 90 degrees a float sine is coarse in angle.
    const auto sine = static_cast<float>(std::sin(grazing_rad));
    const double exact = std::max(kNothing, law(std::asin(static_cast<double>(sine))));
    greatest = std::max(greatest, std::abs(10 * std::log10(std::max<double>(kNothing, table(sine)) / exact)));
  };
  for (int i = 0; i <= 720; ++i) compare(0.125 * i * kDegree);
  for (std::size_t step = 0; step < table.steps().count(); ++step) {
    for (const double part : {0.001, 0.31, 0.69, 0.999}) compare(table.steps().grazing_rad(step, part));
  }
  return greatest;
}

}  // namespace

TEST_CASE("a table is within 0.1 dB of the law: every sediment, 0-90 degrees, 10-1000 kHz") {
  for (const auto& row : named_sediments()) {
    double greatest_db = 0.0;
    for (const double frequency_hz : {10e3, 22e3, 47e3, 100e3, 220e3, 470e3, 1000e3}) {
      const auto law = law_of(row.parameters, frequency_hz, 1500);
      const BackscatterTable table(law);
      CHECK(table.steps().per_octave() <= 32);  // small enough to stay in the nearest cache
      greatest_db = std::max(greatest_db, greatest_error_db(table, law));
    }
    INFO(row.name << " " << greatest_db << " dB");
    CHECK(greatest_db < 0.1);
  }
}

TEST_CASE("so are the tables of capped rock, materials, Lambert, GSAB and tissue") {
  std::vector<Scatterer> scatterers{CappedSediment{sediment_of("rough rock").value()}, Lambert{-25.0},
                                    Gsab{.specular = 0.1, .specular_width_rad = 0.05, .diffuse = 0.01},
                                    Tissue{-20.0, 2.0}};
  for (const auto& row : named_materials()) scatterers.emplace_back(row.material);
  for (std::size_t i = 0; i < scatterers.size(); ++i) {
    const auto law = law_of(scatterers[i], 300e3, 1500);
    INFO("scatterer " << i);
    CHECK(greatest_error_db(BackscatterTable(law), law) < 0.1);
  }
}

TEST_CASE("the law sets a table's steps: few for sediment, more for a specular lobe") {
  const BackscatterTable sand(law_of(sediment_of("fine sand").value(), 300e3, 1500));
  CHECK(sand.steps().per_octave() == 8);
  CHECK(sand.values().size() == 36 * 8 + 2);
  CHECK(sand.error_db() < 0.05);
  const BackscatterTable mirror(law_of(Material{46.0, 0.02, 0.0}, 300e3, 1500));
  CHECK(mirror.steps().per_octave() > 8);
  CHECK(mirror.error_db() < 0.05);
}

TEST_CASE("look-ups by angle and by sine agree; any argument gives a number") {
  const BackscatterTable table(law_of(sediment_of("medium sand").value(), 100e3, 1500));
  for (float angle = 0.0F; angle < 1.57F; angle += 0.05F) CHECK(table.at_angle(angle) == table(std::sin(angle)));
  CHECK(table.at_angle(2.0F) == table(1.0F));
  CHECK(table.at_angle(-1.0F) == table(0.0F));
  CHECK(table(1.5F) == table(1.0F));
  CHECK(table(-0.5F) == table(0.0F));
  CHECK(table(std::numeric_limits<float>::quiet_NaN()) == table(0.0F));
  CHECK(table(std::numeric_limits<float>::infinity()) == table(1.0F));
  CHECK(table(1.0F) == Approx(std::pow(10.0, -0.98)).epsilon(0.02));  // -9.8 dB at normal incidence
  CHECK(table(0.0F) > 0.0F);
}

TEST_CASE("the class of a post chooses its table; an unknown class is the first") {
  const std::vector<Law> laws{law_of(sediment_of("clay").value(), 300e3, 1500),
                              law_of(Material{46.0, 0.02, 0.0}, 300e3, 1500),  // fine steps: all rows get them
                              law_of(sediment_of("rock").value(), 300e3, 1500)};
  const ClassTables tables(laws);
  for (std::uint8_t id = 0; id < 3; ++id) {
    const BackscatterTable alone(laws[id]);
    for (float sine = 0.01F; sine < 1.0F; sine += 0.01F) {
      // Coarser steps of the table alone: twice its error.
      CHECK_THAT(10 * std::log10((tables(id, sine) + 1e-12F) / (alone(sine) + 1e-12F)), WithinAbs(0.0, 0.1));
    }
  }
  CHECK(tables(7, 0.5F) == tables(0, 0.5F));
  CHECK(tables(255, 0.5F) == tables(0, 0.5F));
  CHECK(tables.at_angle(2, 0.5F) == tables(2, std::sin(0.5F)));
  CHECK_THROWS_WITH(ClassTables(std::vector<Law>{}), "0 classes of seabed: allowed are 1 to 256");
}

TEST_CASE("all classes are right together, also where a finer table of one wants to be finer still") {
  // Silt asks for few steps, cobble for twice as many, and of these silt for four times as many.
  const SedimentParameters silt{1.149, 0.9885, 0.00676, 0.001, 3.25, 0.000518};
  const SedimentParameters cobble{2.5, 1.8, 0.01374, 0.002, 3.25, 0.016};
  int mixed = 0;
  for (double slope = 0.0; slope < 0.01; slope += 0.0005) {
    for (double other = 0.0005; other < 0.01; other += 0.001) {
      const std::vector<Law> laws{law_of(MeshedSediment{silt, slope}, 600e3, 1490.0),
                                  law_of(MeshedSediment{cobble, other}, 600e3, 1490.0)};
      const ClassTables tables(laws);
      const int coarse = std::max(BackscatterTable(laws[0], 8).steps().per_octave(),
                                  BackscatterTable(laws[1], 8).steps().per_octave());
      for (const Law& law : laws) mixed += BackscatterTable(law, coarse).steps().per_octave() > coarse ? 1 : 0;
      for (std::uint8_t i = 0; i < 2; ++i) {
        for (const double sine : {0.1, 0.3, 0.6, 0.9}) {
          const double exact = laws[i](std::asin(sine));
          INFO(slope << " " << other << " " << int{i} << " " << sine);
          REQUIRE_THAT(10.0 * std::log10(static_cast<double>(tables(i, static_cast<float>(sine))) / exact),
                       WithinAbs(0.0, 0.1));
        }
      }
    }
  }
  CHECK(mixed > 0);
}
