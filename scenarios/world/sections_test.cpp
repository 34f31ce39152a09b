#include "scenarios/world/testing/sections.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "scenarios/world/cast.h"

namespace ensonify {
namespace {

constexpr double kPi = std::numbers::pi;

struct Section {
  Water water;
  Seabed seabed;
  std::string problems;
};

/// The section of that name ("water: {...}" or "seabed: {...}").
Section section_of(const std::string& text, const std::string& file = "s.yaml") {
  auto from = ConfigReader::from_text(text, file);
  Section section;
  try {
    if (from.has("water")) section.water = read_water(from.section("water"));
    if (from.has("seabed")) section.seabed = read_seabed(from.section("seabed"));
    from.finish();
  } catch (const ConfigError& error) {
    section.problems = error.what();
  }
  return section;
}

std::string problems_of(const std::string& text) { return section_of(text).problems; }

/// A file that lives as long as the test.
struct CastFile {
  explicit CastFile(const std::string& text) { std::ofstream(path) << text; }
  ~CastFile() { std::filesystem::remove(path); }
  std::string problems(const CastColumns& columns = {}) const {
    try {
      read_cast(path, columns);
      return "";
    } catch (const ConfigError& error) {
      std::string what = error.what();
      for (auto at = what.find(path); at != std::string::npos; at = what.find(path)) what.replace(at, path.size(), "c");
      return what;
    }
  }
  std::string path = (std::filesystem::temp_directory_path() / "ensonify_cast_test.csv").string();
};

}  // namespace

TEST_CASE("a profile holds sound speeds, or temperature and salinity, or both") {
  const Section section = section_of(R"(water:
  sound_speed_law: del_grosso
  absorption_law: ainslie_mccolm
  wind_speed_mps: 7
  bubble_loss_db: 1.5
  scattering_layers: [{depth_m: [2, 6], sv_db: -68}, {depth_m: [0, 50], sv_db: -85}]
  profile:
    - {depth_m: 0, sound_speed_mps: 1510}
    - {depth_m: 20, temperature_degc: 9, salinity_psu: 33}
    - {depth_m: 40, sound_speed_mps: 1485, temperature_degc: 8, salinity_psu: 34}
  applied: {profile: [{depth_m: 0, sound_speed_mps: 1505}]}
)");
  REQUIRE(section.problems.empty());
  const Water& water = section.water;
  CHECK(water.sound_speed_law == water::SoundSpeedLaw::kDelGrosso);
  CHECK(water.absorption_law == water::AbsorptionLaw::kAinslieMcColm);
  CHECK(water.wind_speed_mps == 7.0);
  CHECK(water.bubble_loss_db == 1.5);
  REQUIRE(water.scattering_layers.size() == 2);
  CHECK(water.scattering_layers[0].bottom_depth_m == 6.0);
  REQUIRE(water.profile.samples.size() == 3);
  CHECK(water.profile.samples[0].sound_speed_mps == 1510.0);
  CHECK_FALSE(water.profile.samples[1].sound_speed_mps.has_value());
  CHECK(water.profile.samples[1].salinity_psu == 33.0);
  CHECK(water.profile.samples[2].temperature_degc == 8.0);
  CHECK(water.applied.samples.at(0).sound_speed_mps == 1505.0);
}

TEST_CASE("mistakes in the water have a place") {
  CHECK(problems_of("water: {sound_speed_mps: 1490, profile: [{depth_m: 0, sound_speed_mps: 1500}]}") ==
        "s.yaml:1:26: water.sound_speed_mps: stands beside a profile or cast; give one or the other");
  CHECK(problems_of("water: {profile: [{depth_m: 5, sound_speed_mps: 1500}, {depth_m: 5, sound_speed_mps: 1501}]}") ==
        "s.yaml:1:66: water.profile[1].depth_m: is not below the sample before; depths must rise");
  CHECK(problems_of("water: {profile: [{depth_m: 5, temperature_degc: 8}]}") ==
        "s.yaml:1:19: water.profile[0]: needs sound_speed_mps, or temperature_degc and salinity_psu");
  CHECK(problems_of("water: {profile: [{depth_m: 5, sound_speed_mps: 150}]}") ==
        "s.yaml:1:49: water.profile[0].sound_speed_mps: 150 is outside [1300, 1700]");
  CHECK(problems_of("water: {sound_speed_law: unesco, profile: "
                    "[{depth_m: 12000, temperature_degc: 40, salinity_psu: 40}]}") ==
        "s.yaml:1:43: water.profile: makes a sound speed of 1768.9 m/s at 12000 m; allowed: [1300, 1700]");
  CHECK(problems_of("water: {applied: {}}") == "s.yaml:1:18: water.applied: needs sound_speed_mps, profile or cast");
  CHECK(problems_of("water: {scattering_layers: [{depth_m: [9, 4], sv_db: -70}]}") ==
        "s.yaml:1:39: water.scattering_layers[0].depth_m: is not [top, bottom] with the bottom below the top");
  CHECK(problems_of("water: {sound_speed_law: medwin}") ==
        "s.yaml:1:26: water.sound_speed_law: is \"medwin\", not one of mackenzie, unesco, del_grosso");
}

TEST_CASE("a cast is read by the names of its columns or by their numbers") {
  const CastFile named("# a comment\nTime;depth_m;Speed (m/s);temperature_degc\n1;0.5;1501.25;12\n2;1.5;1500;11.5\n");
  CastColumns columns;
  columns.sound_speed_mps = "Speed (m/s)";
  const auto samples = read_cast(named.path, columns);
  REQUIRE(samples.size() == 2);
  CHECK(samples[0].depth_m == 0.5);
  CHECK(samples[0].sound_speed_mps == 1501.25);
  CHECK(samples[1].temperature_degc == 11.5);
  CHECK_FALSE(samples[1].salinity_psu.has_value());

  const CastFile numbered("7.0, 1501, 0.5\r\n7.1, 1500, 1.5\r\n");
  CastColumns numbers;
  numbers.depth_m = "3";
  numbers.sound_speed_mps = "2";
  const auto more = read_cast(numbered.path, numbers);
  REQUIRE(more.size() == 2);
  CHECK(more[1].depth_m == 1.5);
  CHECK(more[1].sound_speed_mps == 1500.0);

  CHECK(section_of("water: {cast: " + named.path + "}").problems.find("needs columns") != std::string::npos);
  const Section by_map = section_of("water: {cast: {path: " + numbered.path + ", depth_m: 3, sound_speed_mps: 2}}");
  CHECK(by_map.problems.empty());
  CHECK(by_map.water.profile.samples.size() == 2);
}

TEST_CASE("two columns of numbers without names are depth and sound speed, whatever stands between them") {
  for (const char* text : {"0.5,1501\n1.5,1500\n", "0.5  1501\r\n 1.5 1500\r\n", "# a title\n\n0.5;1501\n1.5;1500\n"}) {
    const auto samples = read_cast(CastFile(text).path);
    REQUIRE(samples.size() == 2);
    CHECK(samples[1].depth_m == 1.5);
    CHECK(samples[0].sound_speed_mps == 1501.0);
  }
  CHECK(CastFile("0.5 1501\nend\n").problems() == "c:2:1: depth_m: is \"end\", not a number in [0, 12000]");
}

TEST_CASE("mistakes in a cast have a line and a column") {
  CHECK(CastFile("depth_m,sound_speed_mps\n0,1500\n2,fast\n").problems() ==
        "c:3:3: sound_speed_mps: is \"fast\", not a number in [1300, 1700]");
  CHECK(CastFile("depth_m,sound_speed_mps\n0,1500\n2,1500\n 1.5,1500\n").problems() ==
        "c:4:2: depth_m: 1.5 is not below the 2 of the sample before");
  CHECK(CastFile("depth_m,sound_speed_mps\n0,1500\n2\n").problems() == "c:3:1: sound_speed_mps: has no column 2");
  CHECK(CastFile("depth_m,temperature_degc\n0,15\n").problems() ==
        "c:1:1: needs columns for depth_m and sound_speed_mps, or depth_m, temperature_degc and salinity_psu; state "
        "what they are called or their numbers");
  CastColumns columns;
  columns.depth_m = "Depth";
  CHECK(CastFile("depth,sound_speed_mps\n0,1500\n").problems(columns) ==
        "c:1:1: depth_m: there is no column named \"Depth\"");
  CHECK(CastFile("depth_m,sound_speed_mps\n").problems() == "c: holds no sample");
}

TEST_CASE("sediments are named, or given by grain size, parameters, Lambert's law or GSAB") {
  const Section section = section_of(R"(seabed:
  kind: layers
  sediments:
    0: fine sand
    1: {grain_size_phi: 4.5}
    2: {lambert_mu_db: -20}
    3: {name: rough rock, capped: true}
    4: {density_ratio: 1.8, sound_speed_ratio: 1.1, loss: 0.01, volume_parameter: 0.002, spectral_strength_cm4: 0.004}
    5: {gsab: {specular_db: -10, specular_width_deg: 5, diffuse_db: -20}}
)");
  REQUIRE(section.problems.empty());
  const auto& sediments = section.seabed.sediments;
  CHECK(std::get<seabed::SedimentParameters>(sediments.at(0)) == *seabed::sediment_of("fine sand"));
  CHECK(std::get<seabed::SedimentParameters>(sediments.at(1)) == seabed::sediment_of_grain_size(4.5));
  CHECK(std::get<seabed::Lambert>(sediments.at(2)).mu_db == -20.0);
  CHECK(std::get<seabed::CappedSediment>(sediments.at(3)).sediment == *seabed::sediment_of("rough rock"));
  CHECK(std::get<seabed::SedimentParameters>(sediments.at(4)).spectral_exponent == 3.25);
  CHECK(std::get<seabed::Gsab>(sediments.at(5)).specular == Approx(0.1));
  CHECK(std::get<seabed::Gsab>(sediments.at(5)).transition == 0.0);

  const Section bare = section_of("seabed: {kind: layers}");
  CHECK(std::get<seabed::SedimentParameters>(bare.seabed.sediments.at(0)) == *seabed::sediment_of("medium sand"));
}

TEST_CASE("a sediment says itself how steep its facets are") {
  const Section section = section_of(
      "seabed: {kind: tiles, tiles: {folder: .}, sediments: {0: {name: clay, facet_slope_deg: 0}, "
      "1: {name: rock, capped: true, facet_slope_deg: 10}}}");
  REQUIRE(section.problems.empty());
  const auto& clay = std::get<seabed::MeshedSediment>(section.seabed.sediments.at(0));
  CHECK(clay.mean_square_slope == 0.0);
  const auto& rock = std::get<seabed::MeshedSediment>(section.seabed.sediments.at(1));
  CHECK(rock.mean_square_slope == Approx(std::pow(std::tan(10 * kPi / 180), 2)));
  CHECK(std::holds_alternative<seabed::CappedSediment>(rock.whole));
}

TEST_CASE("mistakes in sediments have a place") {
  const auto of = [](const std::string& sediments) {
    return problems_of("seabed: {kind: layers, sediments: {" + sediments + "}}");
  };
  CHECK_THAT(of("0: sponge"),
             Catch::StartsWith("s.yaml:1:39: seabed.sediments.0: is \"sponge\", not one of rough rock"));
  CHECK(of("sand: clay") ==
        "s.yaml:1:42: seabed.sediments.sand: is not a class of the seabed, a whole number in [0, 255]");
  CHECK(of("1: {grain_size_phi: 12}") == "s.yaml:1:56: seabed.sediments.1.grain_size_phi: 12 is outside [-1, 9]");
  CHECK(of("1: {name: clay, lambert_mu_db: -20}") ==
        "s.yaml:1:67: seabed.sediments.1.lambert_mu_db: stands beside name; give one or the other");
  CHECK(of("1: {}") ==
        "s.yaml:1:39: seabed.sediments.1: needs one of name, grain_size_phi, density_ratio (with the "
        "other five), lambert_mu_db, gsab");
  CHECK(of("1: {name: clay, facet_slope_deg: 36}") ==
        "s.yaml:1:69: seabed.sediments.1.facet_slope_deg: 36 is outside [0, 35]");
  CHECK_THAT(of("1: {lambert_mu_db: -20, facet_slope_deg: 3}"),
             Catch::StartsWith("s.yaml:1:60: seabed.sediments.1.facet_slope_deg: is not a known key"));
  CHECK(of("1: {lambert_mu_db: -4}") == "s.yaml:1:55: seabed.sediments.1.lambert_mu_db: -4 is outside [-60, -4.97]");
}

TEST_CASE("a seabed's layers are read from the bottom up, each with its mask") {
  const Section section = section_of(R"(seabed:
  kind: layers
  size_m: [400, 300]
  layers:
    ground: {plane: {depth_m: 12}}
    mud: {spectral: {as_sediment: medium silt, outer_scale_m: 40}}
    rock:
      spectral: {rms_m: 1, outer_scale_m: 30, intermittency: 0.2, rough: {patches: {length_m: 20, share: 0.3}}}
      sediment: 4
    sand: {spectral: {rms_m: 0.1, outer_scale_m: 10}, join: cover, above: ground, mask: {any: [{depth_m: {from: 5}}, {polygon_m: [[0, 0], [10, 0], [0, 10]], soft_m: 2}]}}
    shells: {sediment: 5, mask: {slope_deg: {to: 45, soft: 1}, of: mud, reverse: true}}
    channel: {use: false, dredged: {line_m: [[0, 0, 14], [50, 0, 15]], half_width_m: 9}}
)");
  REQUIRE(section.problems == "");
  const auto& layers = section.seabed.layered.layers;
  REQUIRE(layers.size() == 6);
  CHECK(section.seabed.layered.size_m == frames::Vec2(400, 300));
  // Medium silt's w2 is 5.18e-4 cm^4 at gamma 3.25 [APL1994]: times 10^(6.5 - 8) in SI.
  const auto& mud = std::get<layers::Spectral>(layers[1].form).spectrum;
  CHECK(relief::strength(mud) == Approx(5.175e-4 * std::pow(10.0, -1.5)).epsilon(0.01));
  CHECK(mud.hurst == Approx(0.625));
  CHECK(std::get<layers::Spectral>(layers[2].form).rough->patches->share == 0.3);
  CHECK(layers[2].sediment == 4);
  CHECK(layers[3].join == relief::Layer::Join::kCover);
  CHECK(layers[3].mask->any.size() == 2);
  CHECK(layers[3].mask->any[1].polygon_enu_m[1] == frames::Vec2(10, 0));
  CHECK(std::holds_alternative<layers::Paint>(layers[4].form));
  CHECK(layers[4].mask->slope->high == Approx(1.0));
  CHECK(layers[4].mask->reverse);
  CHECK_FALSE(layers[5].used);
  CHECK(layers[5].join == relief::Layer::Join::kCut);
  CHECK(std::get<layers::Dredged>(layers[5].form).line_enu_m[1].z() == -15.0);
}

TEST_CASE("mistakes in layers have a place") {
  const auto of = [](const std::string& layers) {
    return problems_of("seabed: {kind: layers, layers: {" + layers + "}}");
  };
  CHECK(of("a: {plane: {depth_m: 20}, ripples: {wavelength_m: 1}}") ==
        "s.yaml:1:68: seabed.layers.a.ripples: stands beside plane; a layer is one thing, make two of it");
  CHECK_THAT(of("a: {mask: {}}"), Catch::StartsWith("s.yaml:1:36: seabed.layers.a: is nothing: it needs a sediment to "
                                                    "paint, or one of plane, ramp, wave, sphere, guide"));
  CHECK(of("a: {plane: {}}, b: {spectral: {rms_m: 1, outer_scale_m: 2}, join: cover, above: c}") ==
        "s.yaml:1:113: seabed.layers.b.above: is \"c\", not a layer further up; allowed: a");
  CHECK(of("a: {plane: {}, above: a}") ==
        "s.yaml:1:55: seabed.layers.a.above: is \"a\", not a layer further up; allowed: none\n"
        "s.yaml:1:55: seabed.layers.a.above: needs join: cover or cut; a layer that adds counts from the seabed under "
        "it");
  CHECK(of("a: {spectral: {outer_scale_m: 2}}") ==
        "s.yaml:1:47: seabed.layers.a.spectral: needs rms_m, or as_sediment (a sediment whose roughness goes on)");
  CHECK(of("a: {plane: {}, mask: {polygon_m: [[0, 0], [1], [2, 2]]}}") ==
        "s.yaml:1:66: seabed.layers.a.mask.polygon_m: needs three corners or more\n"
        "s.yaml:1:75: seabed.layers.a.mask.polygon_m[1]: is not a list of 2 numbers, as a place in this list must be");
  CHECK(of("a: {plane: {}, mask: {depth_m: {soft: 1}}}") ==
        "s.yaml:1:64: seabed.layers.a.mask.depth_m: needs from or to");
  CHECK(of("a: {ripples: {wavelength_m: 2, lee_fraction: 0.2}}") ==
        "s.yaml:1:78: seabed.layers.a.ripples.lee_fraction: 0.2 is outside [0.3, 0.5]");
  CHECK(of("") == "s.yaml:1:32: seabed.layers: is empty; at least one layer is needed");
}

}  // namespace ensonify
