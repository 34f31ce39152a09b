#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "components/config/config_text.h"
#include "components/config/scalar_text.h"
#include "launch/dataset/recipe.h"
#include "launch/dataset/scenes.h"

using namespace ensonify;
using namespace ensonify::dataset;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

const std::string kHead = "ensonify: recipe/1\nlaunch: launch/demo.yaml\nhead: eye\n";
const std::string kObjects =
    "objects:\n"
    "  can: { class: small, weight: 3, object: { cylinder: { diameter_m: { uniform: [0.1, 0.2] }, length_m: 0.3 } } }\n"
    "  ball: { class: small, object: { sphere: { diameter_m: 0.2 }, on_seabed: { burial: { uniform: [0, 0.5] } } } }\n"
    "  crate: { object: { box: { size_m: [1, 1, { uniform: [0.5, 1] }] } } }\n";
const std::string kPlace = "place: { east_m: { uniform: [-8, 8] }, north_m: { uniform: [4, 16] } }\n";
const std::string kGood = kHead + kObjects + kPlace;

Recipe recipe_of(const std::string& text) { return read_recipe(parse_config(text, "r.yaml"), "r.yaml"); }

std::string error_of(const std::string& text) {
  try {
    recipe_of(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

/// Mean, least and most of 4,000 numbers.
struct Drawing {
  double mean = 0.0, least = 1e300, most = -1e300;
};
Drawing drawing_of(const std::string& text) {
  constexpr int kCount = 4000;
  Drawing of;
  for (std::uint64_t scene = 0; scene < kCount; ++scene) {
    const double x = draw_number(Drawn(text), "x", {.seed = 3, .scene = scene}, -1e9, 1e9);
    of.mean += x / kCount;
    of.least = std::min(of.least, x), of.most = std::max(of.most, x);
  }
  return of;
}

std::string text_of(const Scene& scene) {
  std::string text = scene.split;
  for (const auto& set : scene.sets) text += "\n" + set;
  for (const auto& arg : scene.args) text += "\n" + arg;
  for (const auto& sample : scene.samples)
    text += "\n" + sample.kind + " " + std::to_string(sample.place[0]) + " " + std::to_string(sample.shift[0]);
  return text;
}

}  // namespace

TEST_CASE("distributions have their means and bounds") {
  // Of 4,000 draws the mean is off by less than four standard errors: 4 sd / sqrt(4000) = 0.063 sd.
  const auto uniform = drawing_of("{uniform: [2, 6]}");
  CHECK_THAT(uniform.mean, WithinAbs(4.0, 0.063 * 4.0 / std::sqrt(12.0)));
  CHECK(uniform.least >= 2.0);
  CHECK(uniform.most <= 6.0);

  const auto logarithmic = drawing_of("{log_uniform: [1, 100]}");  // mean (b - a) / ln(b / a), variance 1085.7 - 462.1
  CHECK_THAT(logarithmic.mean, WithinAbs(99.0 / std::log(100.0), 0.063 * 25.0));
  CHECK(logarithmic.least >= 1.0);
  CHECK(logarithmic.most <= 100.0);

  // Cut at the mean: the mean of the rest is sd sqrt(2 / pi) above, with a deviation of 0.603 sd.
  const auto normal = drawing_of("{normal: [5, 2], within: [5, 100]}");
  CHECK_THAT(normal.mean, WithinAbs(5.0 + 2.0 * std::sqrt(2.0 / M_PI), 0.063 * 1.206));
  CHECK(normal.least >= 5.0);

  const auto integer = drawing_of("{integer: [1, 3]}");
  CHECK_THAT(integer.mean, WithinAbs(2.0, 0.063 * std::sqrt(2.0 / 3.0)));
  CHECK(integer.least == 1.0);
  CHECK(integer.most == 3.0);

  const auto choice = drawing_of("{one_of: [0, 1], weights: [3, 1]}");
  CHECK_THAT(choice.mean, WithinAbs(0.25, 0.063 * std::sqrt(0.25 * 0.75)));
  const auto nested = drawing_of("{one_of: [{uniform: [-2, -1]}, {uniform: [1, 2]}]}");
  CHECK(nested.least >= -2.0);
  CHECK_THAT(nested.mean, WithinAbs(0.0, 0.063 * 1.53));
}

TEST_CASE("a draw follows from its key and number alone") {
  const Drawn one("{a: {uniform: [0, 1]}, b: {uniform: [0, 1]}}"), other("{b: {uniform: [0, 1]}, c: 3}");
  const Counter at{.seed = 5, .scene = 7, .item = 2, .attempt = 1};
  Values first, second;
  draw(one.tree, "x", at, &first);
  draw(other.tree, "x", at, &second);
  REQUIRE(first.size() == 2);
  REQUIRE(second.size() == 1);
  CHECK(first[1].first == "x.b");
  CHECK(first[1].second.scalar == second[0].second.scalar);
  CHECK(first[0].second.scalar != first[1].second.scalar);
  for (const Counter& elsewhere :
       {Counter{6, 7, 2, 1}, Counter{5, 8, 2, 1}, Counter{5, 7, 3, 1}, Counter{5, 7, 2, 2}}) {
    Values moved;
    draw(other.tree, "x", elsewhere, &moved);
    CHECK(moved[0].second.scalar != second[0].second.scalar);
  }
}

TEST_CASE("what is wrong with a recipe is said with its place") {
  CHECK(error_of(kGood) == "");
  CHECK_THAT(error_of("ensonify: recipe/2\n" + kGood.substr(kGood.find('\n') + 1)),
             Contains("r.yaml:1:11: ensonify: recipe/2 is not a format known here; allowed: recipe/1"));
  CHECK_THAT(error_of(kGood + "emty_share: 0.3\n"),
             Contains("emty_share: is not a known key; did you mean empty_share?"));
  CHECK_THAT(error_of(kGood + "draw: { water.salinity_psu: { unifrom: [1, 2] } }\n"),
             Contains("unifrom is not a distribution; did you mean uniform?"));
  CHECK_THAT(error_of(kGood + "draw: { a.b: { uniform: [3, 2] } }\n"), Contains("3 is over 2; allowed: [least, most]"));
  CHECK_THAT(error_of(kGood + "draw: { a.b: { log_uniform: [0, 2] } }\n"), Contains("0 is not over 0"));
  CHECK_THAT(error_of(kGood + "draw: { a.b: { normal: [0, 1] } }\n"), Contains("draw.a.b.within: must be given"));
  CHECK_THAT(error_of(kGood + "draw: { a.b: { normal: [0, 1], within: [5, 6] } }\n"),
             Contains("of the distribution; allowed: 0.1 or more"));
  CHECK_THAT(error_of(kGood + "draw: { a.b: { one_of: [1, 2], weights: [1] } }\n"),
             Contains("is not a list of 2 numbers of 0 or more, one of them over 0"));
  CHECK_THAT(error_of(kGood + "draw: { a.b: { integer: [0, 2.5] } }\n"), Contains("2.5 is not a whole number"));
  CHECK_THAT(error_of(kGood + "draw: { a.b: { by_split: { train: 1, test: 2 } } }\n"),
             Contains("draw.a.b.by_split: is not a map of train, val and test"));
  CHECK_THAT(error_of(kGood + "draw: { a.b: { by_split: { train: 1, val: 1, test: { uniform: 3 } } } }\n"),
             Contains("by_split.test.uniform: is not a list of two numbers"));
  CHECK_THAT(error_of(kGood + "draw: { seed: 4 }\n"), Contains("draw.seed: is drawn for each scene by itself"));
  CHECK_THAT(error_of(kGood + "pairs: { bare: {} }\n"), Contains("pairs.bare: changes nothing; allowed: `without`"));
  CHECK_THAT(error_of(kGood + "pairs: { bare: { draw: { seed: 4 } } }\n"), Contains("pairs.bare.draw.seed: is drawn"));
  CHECK_THAT(error_of(kGood + "formats: [coco, yollo]\n"), Contains("yollo is not a format; did you mean yolo?"));
  CHECK_THAT(error_of(kGood + "splits: { train: 0.5, val: 0.1, test: 0.1 }\n"),
             Contains("splits: train, val and test are 0.7 together; allowed: 1"));
  CHECK_THAT(error_of(kHead + kPlace), Contains("objects: is empty; allowed: one or more, or empty_share: 1"));
  CHECK_THAT(error_of(kHead + kPlace + "objects: { can: { weight: 0, object: { tyre: {} } } }\n"),
             Contains("class can has no objects: all weights are 0"));
  CHECK_THAT(error_of(kHead + kPlace + "objects: { can: { object: { position_m: [1, 2, 3] } } }\n"),
             Contains("objects.can.object.position_m: is given by the recipe"));
}

TEST_CASE("a scene follows from its number, whatever was drawn before") {
  const Recipe recipe = recipe_of(kGood + "draw: { water.temperature_degc: { uniform: [4, 20] } }\nempty_share: 0.3\n");
  const std::string fifth = text_of(draw_scene(recipe, 5));
  std::map<std::string, int> seen;
  for (std::uint64_t number = 9; number > 0; --number) ++seen[text_of(draw_scene(recipe, number))];
  CHECK(seen.size() == 9);
  CHECK(seen[fifth] == 1);
  CHECK_THAT(fifth, Contains("water.temperature_degc="));
}

TEST_CASE("another key leaves the draws of the rest as they are") {
  const Scene one = draw_scene(recipe_of(kGood + "empty_share: 0\n"), 4);
  const Scene more =
      draw_scene(recipe_of(kGood + "empty_share: 0\ndraw: { water.temperature_degc: { uniform: [4, 20] } }\n"), 4);
  REQUIRE(one.sets.size() == 2);
  REQUIRE(more.sets.size() == 3);
  CHECK(more.sets.front() == one.sets.front());
  CHECK(more.sets.back() == one.sets.back());
}

TEST_CASE("empty pictures, classes and kinds have their shares, of few pictures too") {
  const Recipe recipe = recipe_of(kGood + "empty_share: 0.6\n");
  std::map<std::string, int> count;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const auto kind = kind_of(recipe, k);
    ++count[kind ? recipe.objects[*kind].name : "empty"];
    if (k != 99) continue;
    CHECK_THAT(count["empty"], WithinAbs(60, 3));
    CHECK_THAT(count["crate"], WithinAbs(20, 3));
  }
  CHECK_THAT(count["empty"], WithinAbs(600, 4));
  CHECK_THAT(count["crate"], WithinAbs(200, 4));
  CHECK_THAT(count["can"], WithinAbs(150, 4));  // three of four of its class
  CHECK_THAT(count["ball"], WithinAbs(50, 4));
}

TEST_CASE("no slot of a scene has a kind of its own, nor has a split") {
  const Recipe recipe = recipe_of(kGood + "samples: 4\nempty_share: 0.5\npicture: { chip: {} }\n");
  std::array<int, 4> full{};
  std::map<std::string, int> scenes, of_split;
  for (std::uint64_t scene = 0; scene < 400; ++scene) {
    ++scenes[split_of(recipe, scene)];
    for (std::uint64_t slot = 0; slot < 4; ++slot) {
      if (!kind_of(recipe, 4 * scene + slot)) continue;
      ++full[slot];
      ++of_split[split_of(recipe, scene)];
    }
  }
  // Each scene has two objects, in slots as drawn: 200 of a slot, with a deviation of 10.
  for (const int count : full) CHECK_THAT(count, WithinAbs(200, 40));
  for (const auto& [split, count] : scenes) CHECK_THAT(of_split[split], WithinAbs(2.0 * count, 0.1 * count));
}

TEST_CASE("scenes are split by their shares, and a split without a scene is named") {
  const Recipe recipe = recipe_of(kGood);
  std::map<std::string, int> count;
  for (std::uint64_t scene = 0; scene < 1000; ++scene) ++count[split_of(recipe, scene)];
  CHECK_THAT(count["train"], WithinAbs(800, 4));
  CHECK_THAT(count["val"], WithinAbs(100, 4));
  CHECK_THAT(count["test"], WithinAbs(100, 4));
  CHECK(empty_splits(recipe, 1000).empty());
  CHECK(empty_splits(recipe, 1).size() == 2);
  CHECK(empty_splits(recipe_of(kGood + "splits: { train: 1, val: 0, test: 0 }\n"), 1).empty());
}

TEST_CASE("a value may follow from the split") {
  const Recipe recipe = recipe_of(kHead +
                                  "empty_share: 1\nplace: { east_m: 0, north_m: { by_split: { train: { uniform: "
                                  "[0, 10] }, val: { uniform: [100, 110] }, test: 200 } } }\n"
                                  "draw: { seabed.sediments.0: { by_split: { train: mud, val: mud, test: sand } } }\n");
  std::map<std::string, int> seen;
  for (std::uint64_t number = 0; number < 60; ++number) {
    const Scene scene = draw_scene(recipe, number);
    ++seen[scene.split];
    const double north_m = scene.samples[0].place[1];
    CHECK(std::floor(north_m / 100.0) == (scene.split == "train" ? 0.0 : scene.split == "val" ? 1.0 : 2.0));
    CHECK_THAT(scene.sets[1], Contains(scene.split == "test" ? "sand" : "mud"));
  }
  CHECK(seen.size() == 3);
}

TEST_CASE("things keep apart and stand in the sector") {
  const Recipe recipe =
      recipe_of(kHead + kObjects +
                "clutter: { tyre: { count: { integer: [2, 4] }, object: { tyre: {} } } }\nempty_share: 0.3\n"
                "place: { east_m: { uniform: [-8, 8] }, north_m: { uniform: [-8, 16] }, apart_m: 1.5,\n"
                "         seen_from: { range_m: [3, 15], half_angle_deg: 40 } }\n");
  for (std::uint64_t number = 0; number < 50; ++number) {
    const Scene scene = draw_scene(recipe, number);
    for (std::size_t i = 0; i < scene.things.size(); ++i) {
      const auto [east, north] = scene.things[i].place;
      CHECK(std::hypot(east, north) >= 3.0);
      CHECK(std::hypot(east, north) <= 15.0);
      CHECK(std::abs(std::atan2(east, north)) <= 40.0 * M_PI / 180.0);
      for (std::size_t j = 0; j < i; ++j)
        CHECK(std::hypot(east - scene.things[j].place[0], north - scene.things[j].place[1]) >= 1.5);
    }
  }
}

TEST_CASE("a recipe without room says which constraint fails most") {
  const std::string sector = kHead + kObjects +
                             "empty_share: 0\nplace: { east_m: 50, north_m: { uniform: [0, 1] }, tries: 20,\n"
                             "         seen_from: { range_m: [3, 15] } }\n";
  CHECK_THROWS_WITH(
      draw_scene(recipe_of(sector), 2),
      Contains("r.yaml:9:8: place: scene 2 has no room for its 1. thing: of 20 tries 20 fail by seen_from"));
  const std::string crowd = kHead + kObjects +
                            "empty_share: 0\nclutter: { tyre: { count: 40, object: { tyre: {} } } }\n"
                            "place: { east_m: { uniform: [0, 4] }, north_m: { uniform: [0, 4] }, apart_m: 2 }\n";
  CHECK_THROWS_WITH(draw_scene(recipe_of(crowd), 0), Contains("fail by apart_m"));
}

TEST_CASE("a pair is the same scene but for what its recipe says") {
  const std::string rest = "empty_share: 0\nclutter: { tyre: { object: { tyre: {} } } }\n";
  const Recipe recipe =
      recipe_of(kGood + rest +
                "pairs:\n"
                "  bare: { without: objects }\n"
                "  muddy: { draw: { seabed.sediments.0: { one_of: [mud, silt] } }, without: clutter }\n");
  const Scene scene = draw_scene(recipe, 5);
  CHECK(text_of(scene) == text_of(draw_scene(recipe_of(kGood + rest), 5)));
  REQUIRE(scene.things.size() == 2);
  const std::vector<Scene> pairs = pairs_of(recipe, scene);
  REQUIRE(pairs.size() == 2);
  for (const Scene& pair : pairs) {
    CHECK(std::equal(scene.sets.begin(), scene.sets.end(), pair.sets.begin()));
    CHECK(pair.split == scene.split);
    CHECK(pair.seed == scene.seed);
  }
  CHECK(pairs[0].pair == "bare");
  CHECK(pairs[0].sets.size() == scene.sets.size() + 1);
  CHECK(pairs[0].sets.back() == "objects." + scene.things[0].name + ".absent=true");
  CHECK(pairs[0].samples[0].kind.empty());
  CHECK(pairs[1].sets.size() == scene.sets.size() + 2);
  CHECK_THAT(pairs[1].sets[scene.sets.size()],
             Contains("seabed.sediments.0=\"mud\"") || Contains("seabed.sediments.0=\"silt\""));
  CHECK(pairs[1].sets.back() == "objects." + scene.things[1].name + ".absent=true");
  CHECK(pairs[1].samples[0].kind == scene.samples[0].kind);
}

TEST_CASE("chips stand one step apart, each with its own kind") {
  const Recipe recipe = recipe_of(kHead + kObjects +
                                  "samples: 20\nempty_share: 0.5\npicture: { chip: {} }\n"
                                  "place: { east_m: { uniform: [10, 20] }, north_m: 5, step_m: [0, 30] }\n");
  const Scene scene = draw_scene(recipe, 3);
  REQUIRE(scene.samples.size() == 20);
  int empty = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    CHECK(scene.samples[i].number == 60 + i);
    CHECK(scene.samples[i].place[1] == 5.0 + 30.0 * static_cast<double>(i));
    CHECK(std::abs(scene.samples[i].shift[0]) <= 1.0);
    empty += scene.samples[i].kind.empty() ? 1 : 0;
  }
  CHECK_THAT(empty, WithinAbs(10, 3));
  CHECK(scene.things.size() == static_cast<std::size_t>(20 - empty));
}

TEST_CASE("an object is written as a scenario has it, its place put in") {
  const Recipe recipe =
      recipe_of(kHead +
                "empty_share: 0\nobjects:\n"
                "  mine: { object: { sphere: { diameter_m: 0.5 }, on_seabed: { burial: 0.2 }, sediment: 1 } }\n"
                "place: { east_m: 1.5, north_m: 7 }\n");
  CHECK(
      draw_scene(recipe, 0).sets.back() ==
      R"(objects.mine_0_1={"sphere":{"diameter_m":0.5},"on_seabed":{"burial":0.2,"at_m":[1.5,7]},"sediment":1,"class":"mine"})");
  const Recipe hanging =
      recipe_of(kHead +
                "empty_share: 0\nobjects: { buoy: { object: { sphere: { diameter_m: 0.5 } }, up_m: -3 } }\n"
                "place: { east_m: 1.5, north_m: 7 }\n");
  CHECK(draw_scene(hanging, 0).sets.back() ==
        R"(objects.buoy_0_1={"sphere":{"diameter_m":0.5},"class":"buoy","position_m":[1.5,7,-3]})");
}
