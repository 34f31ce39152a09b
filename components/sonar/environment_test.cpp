#include "components/sonar/environment.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <vector>

#include "components/config/config_reader.h"
#include "kernels/seabed/relief/spectral_surface.h"
#include "kernels/water/noise.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

double db(double ratio) { return 10.0 * std::log10(ratio); }

/// A world of the given water and sediments, over layers of its seabed.
World world_with(const std::string& water, const std::string& sediments = "{}",
                 const std::string& layers = "{ground: {plane: {}}}") {
  auto from = ConfigReader::from_text(
      "ensonify: scenario/1\nsite: {latitude_deg: 45, longitude_deg: 0}\nwater: " + water +
          "\nseabed: {kind: layers, post_spacing_m: 0.1, sediments: " + sediments + ", layers: " + layers +
          "}\nvehicles: {auv: {mountings: {bow: {actual: {}}}}}\n"
          "mission: {depth_m: 10, runlines: [{from_m: [0, 0], to_m: [100, 0]}]}\n",
      "world.yaml");
  const World world = read_world(from, "world.yaml");
  from.finish();
  return world;
}

}  // namespace

TEST_CASE("water without a profile has one speed everywhere") {
  CHECK(true_profile(world_with("{sound_speed_mps: 1490}")).knots()[0].speed_mps == 1490.0);
  const auto of_salt_and_warmth = true_profile(world_with("{temperature_degc: 12, salinity_psu: 32}"));
  REQUIRE(of_salt_and_warmth.knots().size() == 1);
  CHECK(of_salt_and_warmth.speed_mps(500.0) == water::sound_speed_mps(12.0, 32.0, 10.0));
}

TEST_CASE("a profile is linear between its samples, by the law that is asked for") {
  const std::string samples =
      "profile: [{depth_m: 0, sound_speed_mps: 1520}, "
      "{depth_m: 1000, temperature_degc: 25, salinity_psu: 35}]";
  const auto profile = true_profile(world_with("{" + samples + "}"));
  // [Mackenzie1981]: the published check value.
  CHECK_THAT(profile.speed_mps(1000.0), WithinAbs(1550.744, 1e-3));
  CHECK_THAT(profile.speed_mps(500.0), WithinAbs(0.5 * (1520.0 + 1550.744), 1e-3));
  const auto unesco = true_profile(world_with("{sound_speed_law: unesco, " + samples + "}"));
  CHECK(unesco.speed_mps(1000.0) ==
        water::sound_speed_mps(water::SoundSpeedLaw::kUnesco, 25.0, 35.0, 1000.0, std::numbers::pi / 4));
}

TEST_CASE("the applied profile is the true one until another is stated") {
  const World knows = world_with("{sound_speed_mps: 1490}");
  CHECK(applied_profile(knows) == true_profile(knows));
  const World errs = world_with("{sound_speed_mps: 1490, applied: {sound_speed_mps: 1500}}");
  CHECK(applied_profile(errs).speed_mps(0.0) == 1500.0);
  CHECK(true_profile(errs).speed_mps(0.0) == 1490.0);
}

TEST_CASE("a cast of temperature and salinity gives the sound speed that its probe printed") {
  const char* shared = std::getenv("ENSONIFY_SHARED");
  const std::string cast =
      std::string(shared != nullptr ? shared : "") + "/data/ssp/portsmouth_castaway_20120821_1228.csv";
  if (!std::filesystem::exists(cast)) {
    WARN("skipped: no data/ssp/portsmouth_castaway_20120821_1228.csv in the folder that ENSONIFY_SHARED names");
    return;
  }
  const std::string columns = "path: " + cast + ", depth_m: Depth (Meter)";
  const World computed = world_with("{sound_speed_law: unesco, cast: {" + columns +
                                    ", temperature_degc: Temperature (Celsius), "
                                    "salinity_psu: Salinity (Practical Salinity Scale)}}");
  const World printed = world_with("{cast: {" + columns + ", sound_speed_mps: Sound velocity (Meters per Second)}}");
  REQUIRE(computed.water.profile.samples.size() == printed.water.profile.samples.size());
  REQUIRE(computed.water.profile.samples.size() > 50);
  // The probe computes by the same law; both profiles are thinned to 0.01 m/s, and ITS-90 stands for ITS-68.
  for (double depth_m = 0.5; depth_m < 20.0; depth_m += 0.5) {
    CAPTURE(depth_m);
    CHECK_THAT(true_profile(computed).speed_mps(depth_m), WithinAbs(true_profile(printed).speed_mps(depth_m), 0.05));
  }
  CHECK(true_profile(computed).knots().size() < computed.water.profile.samples.size());
}

TEST_CASE("absorption is that of the water between two depths") {
  // [Francois1982], printed: 73.1 dB/km at 300 kHz, 10 degC, 35 psu, pH 8, at the surface.
  const Environment surface(world_with("{temperature_degc: 10, salinity_psu: 35}"), 300e3);
  CHECK_THAT(surface.absorption_dbpm(0.0, 0.0), WithinAbs(0.0731, 5e-5));
  CHECK(surface.absorption_dbpm(0.0, 100.0) < surface.absorption_dbpm(0.0, 0.0));  // pressure lowers it
  const Environment warm_above(world_with("{profile: [{depth_m: 0, temperature_degc: 20, salinity_psu: 35}, "
                                          "{depth_m: 50, temperature_degc: 5, salinity_psu: 35}]}"),
                               300e3);
  CHECK(warm_above.absorption_dbpm(0.0, 50.0) == warm_above.absorption_dbpm(50.0, 0.0));
  CHECK(warm_above.absorption_dbpm(0.0, 0.0) > warm_above.absorption_dbpm(0.0, 50.0));
  const Environment ainslie(world_with("{absorption_law: ainslie_mccolm}"), 300e3);
  CHECK(ainslie.absorption_dbpm(0.0, 0.0) != surface.absorption_dbpm(0.0, 0.0));
  CHECK(Environment(world_with("{absorption_db_per_km: 60}"), 300e3).absorption_dbpm(0.0, 80.0) == Approx(0.06));
}

TEST_CASE("noise is thermal in calm water, more in wind, and the stated level where given") {
  CHECK(Environment(world_with("{}"), 300e3).noise_level_db() == Approx(water::thermal_noise_level_db(300e3)));
  CHECK(Environment(world_with("{wind_speed_mps: 10}"), 50e3).noise_level_db() ==
        Approx(water::ambient_noise_level_db(50e3, 10.0)));
  CHECK(Environment(world_with("{wind_speed_mps: 10}"), 50e3).noise_level_db() >
        water::thermal_noise_level_db(50e3) + 3.0);
  CHECK(Environment(world_with("{wind_speed_mps: 10, noise_level_db: 40}"), 50e3).noise_level_db() == 40.0);
}

TEST_CASE("each class scatters by its sediment; classes without one as class 0") {
  const double c_mps = 1500.0;
  const auto medium_sand = seabed::law_of(*seabed::sediment_of("medium sand"), 300e3, c_mps);
  const Environment all_sand(world_with("{sound_speed_mps: 1500}"), 300e3);
  const Environment mixed(world_with("{sound_speed_mps: 1500}", "{0: {lambert_mu_db: -25}, 2: rock}"), 300e3);
  const auto rock = seabed::law_of(*seabed::sediment_of("rock"), 300e3, c_mps);
  for (const double grazing_deg : {5.0, 20.0, 45.0, 70.0, 90.0}) {
    const double grazing = grazing_deg * std::numbers::pi / 180;
    const auto in_table = [&](const Environment& environment, std::uint8_t number) {
      return db(environment.backscatter().at_angle(number, static_cast<float>(grazing)));
    };
    // Tables are within 0.1 dB of their law.
    CHECK_THAT(in_table(all_sand, 0), WithinAbs(db(medium_sand(grazing)), 0.1));
    CHECK(in_table(all_sand, 77) == in_table(all_sand, 0));
    CHECK_THAT(in_table(mixed, 0), WithinAbs(-25.0 + 20.0 * std::log10(std::sin(grazing)), 0.1));
    CHECK(in_table(mixed, 1) == in_table(mixed, 0));
    CHECK_THAT(in_table(mixed, 2), WithinAbs(db(rock(grazing)), 0.1));
  }
}

TEST_CASE("mud with its relief in the mesh returns on average what a plane of it returns") {
  const World mud = world_with("{sound_speed_mps: 1500}", "{0: medium silt}",
                               "{ground: {plane: {}}, mud: {spectral: {as_sediment: medium silt, outer_scale_m: 20}}}");
  // What the pager indicates it: facets' slopes, which are all of the sediment's relief between posts.
  const auto& spectrum = std::get<layers::Spectral>(mud.seabed.layered.layers[1].form).spectrum;
  const Environment environment(mud, 300e3);
  Environment::FacetLaws memory;
  const auto& facets = environment.backscatter(std::vector{relief::facet_mean_square_slope(spectrum, 0.1)}, memory);
  const auto whole = seabed::law_of(*seabed::sediment_of("medium silt"), 300e3, 1500.0);

  // The heights that the pager would make, each cell two triangles as the tracer has them.
  constexpr int kPosts = 300;
  const relief::Window window{0, 0, 0, kPosts, kPosts};
  std::vector<float> z(window.size());
  relief::SpectralSurface(spectrum, 0.1, 3, "mud").fill(window, z);
  const auto mean_over_facets = [&](const auto& law, double grazing) {
    const frames::Vec3 to_sonar(std::cos(grazing), 0.0, std::sin(grazing));
    double sum = 0.0;
    const auto add = [&](double east, double north) {
      const frames::Vec3 area(-east, -north, 1.0);  // of the facet over that of its plan
      const double sine = area.normalized().dot(to_sonar);
      if (sine > 0.0) sum += area.norm() * law(std::asin(std::min(sine, 1.0)));
    };
    for (int j = 0; j + 1 < kPosts; ++j) {
      for (int i = 0; i + 1 < kPosts; ++i) {
        const auto at = [&](int a, int b) { return static_cast<double>(z[window.node(a, b)]); };
        add((at(i + 1, j) - at(i, j)) / 0.1, (at(i, j + 1) - at(i, j)) / 0.1);
        add((at(i + 1, j + 1) - at(i, j + 1)) / 0.1, (at(i + 1, j + 1) - at(i + 1, j)) / 0.1);
      }
    }
    return sum / (2.0 * (kPosts - 1) * (kPosts - 1));
  };
  const auto of_head = [&](double grazing) {
    return static_cast<double>(facets.at_angle(0, static_cast<float>(grazing)));
  };
  for (const double grazing_deg : {20.0, 45.0, 70.0, 83.0, 90.0}) {
    const double grazing = grazing_deg * std::numbers::pi / 180;
    INFO(grazing_deg);
    // 0.3 dB: what the law of facets is off at most; 180,000 facets scatter by less than 0.05 dB.
    CHECK_THAT(db(mean_over_facets(of_head, grazing)), WithinAbs(db(whole(grazing)), 0.3));
  }
  const double up = 0.5 * std::numbers::pi;
  CHECK(db(mean_over_facets(whole, up)) < db(whole(up)) - 0.8);  // with the plane's law on the facets
}

TEST_CASE("facet slopes are the mesh's, by class, unless the scenario states them") {
  const World world = world_with("{sound_speed_mps: 1500}",
                                 "{0: medium silt, 1: {name: medium silt, facet_slope_deg: 3}, 2: medium silt, "
                                 "3: {lambert_mu_db: -20}, 4: {name: medium silt, capped: true}}");
  const auto up = [](const seabed::ClassTables& tables, std::uint8_t number) {
    return db(tables.at_angle(number, 0.5F * std::numbers::pi_v<float>));
  };
  const Environment environment(world, 300e3);
  Environment::FacetLaws memory;
  const auto& plane = environment.backscatter();
  const auto& faceted = environment.backscatter(std::vector{0.002, 0.002, 0.0, 0.002, 0.002}, memory);
  CHECK(up(faceted, 0) > up(plane, 0) + 0.1);  // facets stand for more than they return alone
  CHECK(up(faceted, 1) == up(plane, 1));
  CHECK(up(faceted, 2) == up(plane, 2));
  CHECK(up(faceted, 3) == up(plane, 3));
  CHECK_THAT(up(faceted, 4), WithinAbs(up(faceted, 0), 0.02));  // the limit is off at right angles; tables have 0.01 dB
  CHECK(up(environment.backscatter({}, memory), 0) == up(plane, 0));
}

TEST_CASE("wind roughens the surface") {
  // [Pierson1964]: a significant height of 0.53 m at 5 m/s, four times the rms.
  CHECK_THAT(Environment(world_with("{wind_speed_mps: 5}"), 70e3).rms_wave_height_m(), WithinAbs(0.53 / 4, 0.002));
  CHECK(Environment(world_with("{}"), 70e3).rms_wave_height_m() == 0.0);
}

TEST_CASE("layers of scatterers and loss in bubbles come through") {
  const Environment environment(world_with("{bubble_loss_db: 2, scattering_layers: [{depth_m: [5, 15], sv_db: -70}]}"),
                                200e3);
  CHECK(environment.bubble_loss_db() == 2.0);
  CHECK(water::volume_scattering_db(environment.scattering_layers(), 10.0) == Approx(-70.0));
  CHECK(std::isinf(water::volume_scattering_db(environment.scattering_layers(), 20.0)));
}
