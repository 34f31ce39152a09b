#include "components/terrain/meshed_relief.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "components/config/config_reader.h"
#include "components/terrain/layers_source.h"
#include "scenarios/world/seabed.h"
#include "scenarios/world/testing/sections.h"

using namespace ensonify;
using namespace ensonify::source;
using Catch::WithinAbs;

namespace {

Seabed seabed_from(const std::string& text) {
  auto from = ConfigReader::from_text(text, "s.yaml");
  Seabed seabed = read_seabed(from.section("seabed"));
  from.finish();
  seabed.layered.seed = 7;
  return seabed;
}

MeshedRelief relief_of(const Seabed& seabed, const GuideReader& read_guide = {}) {
  return meshed_relief(seabed, fields_of(seabed.layered, seabed.post_spacing_m, read_guide));
}

std::map<std::uint8_t, seabed::Scatterer> sediments_on_mesh(const Seabed& seabed, const GuideReader& read_guide = {}) {
  return on_mesh(seabed.sediments, relief_of(seabed, read_guide).mean_square_slope);
}

double slope_of(const seabed::Scatterer& scatterer) {
  const auto* meshed = std::get_if<seabed::MeshedSediment>(&scatterer);
  return meshed == nullptr ? 0.0 : meshed->mean_square_slope;
}

// 2 C^2 d^-0.75, C^2 = 11.17 w2 and d = 10 in cm [APL1994]; 0.000518 and 0.006957 cm^4: medium silt and coarse sand.
const double kOfStrength = 2 * 11.17 * std::pow(10.0, -0.75);
const std::string kSilt = "as_sediment: medium silt, outer_scale_m: 1000";

/// Coarse sand painted with a tenth of class 1, and another layer.
Seabed seabed_with(const std::string& layer, const std::string& ground = "{plane: {depth_m: 20}}") {
  return seabed_from(R"(seabed:
  kind: layers
  post_spacing_m: 0.1
  size_m: [400, 200]
  sediments: {0: coarse sand, 1: coarse sand}
  layers:
    ground: )" + ground +
                     R"(
    paint: {mask: {patches: {length_m: 10, share: 0.1}}, sediment: 1}
    silt: {)" + layer +
                     "}\n");
}

std::string masked(const std::string& mask) { return "spectral: {" + kSilt + "}, mask: {" + mask + "}"; }

/// Counted mean square slope over that of medium silt everywhere.
double share_of_silt(const Seabed& seabed, std::uint8_t seabed_class = 0, const GuideReader& read_guide = {}) {
  return slope_of(sediments_on_mesh(seabed, read_guide).at(seabed_class)) / (kOfStrength * 0.000518);
}

/// Medium silt, 60 m x 60 m, with posts of 0.1 m on a bottom of 1:191.
Seabed silt_with(const std::string& layers) {
  return seabed_from(
      "seabed: {kind: layers, post_spacing_m: 0.1, size_m: [60, 60], sediments: {0: medium silt}, layers: "
      "{ground: {plane: {depth_m: 20, slope_deg: 0.3}}, " +
      layers + "}}");
}

/// What the facets of a square of 40 m return straight up over what the plane's law says, in dB. Only of cells whose
/// south-west post satisfies `here`, given its north coordinate.
double returned_db(const Seabed& seabed, const seabed::Law& law, const std::function<bool(double)>& here,
                   double frequency_hz = 300e3) {
  constexpr std::size_t kCells = 400, kPosts = kCells + 1;
  std::vector<float> height_m(kPosts * kPosts);
  std::vector<std::uint8_t> sediment(height_m.size());
  const PostBlock block{-200, -200, kPosts, kPosts, 0.1};
  LayersSource(seabed, {54.0, -10.0}).sample(block, height_m, sediment);
  double sum = 0.0;
  int facets = 0;
  for (std::size_t row = 0; row < kCells; ++row) {
    if (!here(block.north_m(static_cast<int>(row)))) continue;
    for (std::size_t column = 0; column < kCells; ++column) {
      const float* z = &height_m[row * kPosts + column];
      const auto add = [&](float east_m, float north_m) {
        const double area = std::hypot(1.0, east_m / 0.1, north_m / 0.1);
        sum += area * law(std::asin(1.0 / area));
        ++facets;
      };
      add(z[1] - z[0], z[kPosts] - z[0]);
      add(z[kPosts + 1] - z[kPosts], z[kPosts + 1] - z[1]);
    }
  }
  const seabed::Law whole = seabed::law_of(*seabed::sediment_of("medium silt"), frequency_hz, 1500.0);
  return 10.0 * std::log10(sum / facets / whole(0.5 * std::numbers::pi));
}

seabed::Law law_on_mesh(const Seabed& seabed, double frequency_hz = 300e3) {
  return seabed::law_of(sediments_on_mesh(seabed).at(0), frequency_hz, 1500.0);
}

const auto kAll = Approx(1.0).epsilon(0.005);  // the outer scale's part: 0.4 %

}  // namespace

TEST_CASE("relief in a layered seabed's heights is passed to its scattering law by class") {
  const Seabed seabed = seabed_from(R"(seabed:
  kind: layers
  post_spacing_m: 0.1
  sediments: {0: medium silt, 1: rock, 2: coarse sand, 3: {name: clay, facet_slope_deg: 0}, 4: {name: rock, capped: true}, 5: {lambert_mu_db: -20}}
  layers:
    ground: {plane: {}}
    mud: {spectral: {as_sediment: medium silt, outer_scale_m: 1000}}
    rock: {spectral: {as_sediment: rock, outer_scale_m: 1000, intermittency: 0.02}, sediment: 1}
    sand: {spectral: {as_sediment: coarse sand, outer_scale_m: 1000}, join: cover, above: ground, sediment: 2}
    patches: {spectral: {rms_m: 9, outer_scale_m: 30}, mask: {patches: {length_m: 20, share: 0.3}}}
    not_there: {use: false, spectral: {rms_m: 9, outer_scale_m: 30}}
)");
  const auto sediments = sediments_on_mesh(seabed);
  // Coarse sand has the mud's slopes under its own, but no more than its own count.
  CHECK(slope_of(sediments.at(0)) == Approx(kOfStrength * 0.000518).epsilon(0.005));
  // The mud's and rock's own, w2 = 0.01862 cm^4. Its cascade has nine octaves (from 128 m to posts 0.4 m apart), each
  // of variance 0.02 ln 2 of ln amplitude, within 2 %: half of all places have less than exp(-2 x 9 x 0.02 ln 2) of the
  // mean square.
  CHECK(slope_of(sediments.at(1)) ==
        Approx(kOfStrength * (0.000518 + 0.01862 * std::exp(-0.36 * std::log(2.0)))).epsilon(0.02));
  CHECK(slope_of(sediments.at(2)) == Approx(kOfStrength * 0.006957).epsilon(0.005));
  CHECK(slope_of(sediments.at(3)) == 0.0);
  CHECK(slope_of(sediments.at(4)) == slope_of(sediments.at(0)));
  CHECK(std::holds_alternative<seabed::CappedSediment>(std::get<seabed::MeshedSediment>(sediments.at(4)).whole));
  CHECK(std::holds_alternative<seabed::Lambert>(sediments.at(5)));

  // A tile set's heights have what its own file says, to the last bit: the layers' slope is rounded for that.
  const double reported_deg = facet_slope_deg(std::get<seabed::MeshedSediment>(sediments.at(0)));
  const Seabed on_tiles =
      seabed_from("seabed: {kind: tiles, tiles: {folder: .}, sediments: {0: {name: medium silt, facet_slope_deg: " +
                  std::to_string(reported_deg) + "}}}");
  CHECK(slope_of(on_tiles.sediments.at(0)) == slope_of(sediments.at(0)));
}

TEST_CASE("of uneven layers the slope of a typical place counts") {
  const auto spectral = [](const std::string& more) {
    return share_of_silt(seabed_with("spectral: {" + kSilt + ", " + more + "}"));
  };
  CHECK(spectral("rough: {patches: {length_m: 10, share: 0.6}}, smooth_amplitude: 0.5") == kAll);
  CHECK(spectral("rough: {patches: {length_m: 10, share: 0.4}}, smooth_amplitude: 0.5") == Approx(0.25).epsilon(0.005));
  CHECK(spectral("intermittency: 0.05") == Approx(std::exp(-2 * 9 * 0.05 * std::log(2.0))).epsilon(0.03));  // 9 octaves
  CHECK(spectral("height_gain: 0.3") ==
        Approx(std::exp(-2 * 0.09)).epsilon(0.01));  // nearly all of the height's variance
}

TEST_CASE("a masked layer counts in a class at half of whose places and more it holds") {
  const auto of = [](const std::string& mask) { return share_of_silt(seabed_with(masked(mask))); };
  CHECK(of("patches: {length_m: 5, share: 0.6}") == kAll);
  CHECK(of("patches: {length_m: 5, share: 0.4}") == 0.0);
  CHECK(of("patches: {length_m: 5, share: 0.4}, reverse: true") == kAll);
  CHECK(of("sediment: [0]") == kAll);
  CHECK(of("sediment: [1]") == 0.0);
  CHECK(share_of_silt(seabed_with(masked("sediment: [1]")), 1) == kAll);
  const std::string three_quarters = "polygon_m: [[-100, -300], [300, -300], [300, 300], [-100, 300]]";
  CHECK(of(three_quarters) == kAll);
  CHECK(of(three_quarters + ", patches: {length_m: 5, share: 0.55}") == 0.0);                              // 0.41
  CHECK(of("any: [{patches: {length_m: 5, share: 0.4}}, {patches: {length_m: 5, share: 0.4}}]") == kAll);  // 0.64
  CHECK(of("any: [{patches: {length_m: 5, share: 0.25}}, {patches: {length_m: 5, share: 0.2}}]") == 0.0);  // 0.40
}

TEST_CASE("what a mask of the seabed's shape holds on is looked up on the seabed") {
  // 2 degrees along north, +-3.5 m of depth: 20 m deep in the middle. Waves 40 m long and 1 m high: 9 degrees at most,
  // above 4.5 at two thirds of the places. Hollows are half of them.
  const std::string slope = "{plane: {depth_m: 20, slope_deg: 2}}",
                    waves = "{wave: {amplitude_m: 1, wavelength_m: 40}}";
  const auto of = [](const std::string& ground, const std::string& mask) {
    return share_of_silt(seabed_with(masked(mask), ground));
  };
  CHECK(of(slope, "depth_m: {to: 21}") == kAll);
  CHECK(of(slope, "depth_m: {to: 19}") == 0.0);
  CHECK(of(slope, "depth_m: {to: 19}, reverse: true") == kAll);
  CHECK(of(waves, "slope_deg: {from: 4}") == kAll);
  CHECK(of(waves, "slope_deg: {from: 7}") == 0.0);
  CHECK(of(waves, "curvature_1pm: {from: -0.006}") == kAll);
  CHECK(of(waves, "curvature_1pm: {from: 0.006}") == 0.0);
}

TEST_CASE("what a mask of a guide's shape holds on is looked up on the guide") {
  const GuideReader read_guide = [](const layers::Guide&) {  // 2 degrees to the north, and waves to the east, as above
    relief::Raster raster{82, 42, 5.0, {-205.0, -105.0}, {}};
    for (int row = 0; row < 42; ++row) {
      for (int column = 0; column < 82; ++column) {
        const double east_m = 5.0 * column - 205.0, north_m = 5.0 * row - 105.0;
        raster.value.push_back(
            static_cast<float>(-20.0 - 0.035 * north_m + std::sin(2.0 * std::numbers::pi * east_m / 40.0)));
      }
    }
    return raster;
  };
  const auto of = [&](const std::string& mask) {
    Seabed seabed = seabed_with(masked(mask));
    seabed.layered.layers[0].form = layers::Guide{};
    return seabed;
  };
  const auto share = [&](const std::string& mask) { return share_of_silt(of(mask), 0, read_guide); };
  CHECK(share("depth_m: {to: 21}") == kAll);
  CHECK(share("depth_m: {to: 19}") == 0.0);
  CHECK(share("slope_deg: {from: 4}") == kAll);
  CHECK(share("slope_deg: {from: 7}") == 0.0);
  CHECK(share("curvature_1pm: {from: -0.006}") == kAll);
  CHECK(share("curvature_1pm: {from: 0.006}") == 0.0);
  const auto uneven = relief_of(of("depth_m: {to: 21}"), read_guide).uneven;
  REQUIRE(uneven.size() == 2);  // classes 0 and 1
  CHECK_THAT(uneven[0].share, WithinAbs(0.62, 0.03));
  CHECK_THAT(text_of(uneven[0]), Catch::Contains("layer silt holds at 0.6"));
}

TEST_CASE("facets of a partly rough seabed return on average what the plane's law gives") {
  // Medium silt at right angles, where twice the slopes are 1 dB: all facets between posts of a square of 40 m, five
  // outer scales and 40 patches of the cascade a side.
  const auto everywhere = [](double) { return true; };
  for (const char* layer :
       {"{spectral: {as_sediment: medium silt, outer_scale_m: 8, intermittency: 0.1}}",
        "{spectral: {as_sediment: medium silt, outer_scale_m: 8, height_gain: 0.4}}",
        "{spectral: {as_sediment: medium silt, outer_scale_m: 8}, mask: {patches: {length_m: 4, share: 0.7}}}",
        // 1:191, so 20.07 m are 13.4 m north of the middle: 0.72 of 60 m, 0.83 of these 40 m
        "{spectral: {as_sediment: medium silt, outer_scale_m: 8}, mask: {depth_m: {to: 20.07}, of: ground}}"}) {
    INFO(layer);
    const Seabed seabed = silt_with(std::string("silt: ") + layer);
    CHECK_THAT(returned_db(seabed, law_on_mesh(seabed), everywhere), WithinAbs(0.0, 0.3));
    CHECK(returned_db(seabed, seabed::law_of(seabed.sediments.at(0), 300e3, 1500.0), everywhere) < -0.6);
  }
}

TEST_CASE("for a class that is rough in part, the smaller part's error in dB is reported") {
  // 1:191, so 20.03 m are 5.7 m north of the middle: 0.6 of 60 m. The next case has the rough part there and to the
  // north.
  const std::string silt = "spectral: {as_sediment: medium silt, outer_scale_m: 8}, mask: {depth_m: {";
  const auto of = [&](const std::string& band) { return silt_with("silt: {" + silt + band + "}, of: ground}}"); };
  for (const bool rough_is_more : {true, false}) {
    const Seabed seabed = of(rough_is_more ? "to: 20.03" : "from: 20.03");
    const auto uneven = relief_of(seabed).uneven;
    REQUIRE(uneven.size() == 1);
    CHECK(uneven[0].layer == "silt");
    CHECK(uneven[0].seabed_class == 0);
    CHECK_THAT(uneven[0].share, WithinAbs(rough_is_more ? 0.6 : 0.4, 0.02));  // 64 rows of places
    // At 100 kHz they are off by more: there the lobe that facets are left with is narrower.
    const seabed::Law law = law_on_mesh(seabed, 100e3);
    const double lesser_db = returned_db(
        seabed, law, [](double north_m) { return north_m > 6.0; }, 100e3);
    const double greater_db = returned_db(
        seabed, law, [](double north_m) { return north_m < 5.0; }, 100e3);
    CHECK_THAT(uneven[0].off_db, WithinAbs(lesser_db - greater_db, 0.2));  // 100,000 facets and more on either part
    CHECK(uneven[0].off_db * (rough_is_more ? 1 : -1) > 2.0);
  }
  CHECK(relief_of(of("to: 20.15")).uneven.empty());  // all but 0.02
  CHECK(relief_of(seabed_with(masked("sediment: [0]"))).uneven.empty());
}
