#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "components/config/parameter_info.h"
#include "components/config/read_parameters.h"
#include "launch/dataset/draws.h"

/// What a labelled data set is made of.
namespace ensonify::dataset {

inline constexpr double kFarAway_m = 1e5;

/// A kind of thing.
struct Kind {
  std::string name;
  static constexpr auto kNamedBy = &Kind::name;
  std::string class_name;
  double weight = 1.0;
  Drawn count{"1"};
  Drawn object, up_m;

  static void parameters(auto& self, auto&& visit) {
    visit("class", "", computed(not_empty()), "class in the labels; left out: its name", self.class_name);
    visit("weight", "", in(0, 1e6), "share among the kinds of its class", self.weight);
    visit("count", "", any(), "number of them in a picture", self.count);
    visit("object", "", must(any()), "entry of a scenario's `objects:`, without its place", self.object);
    visit("up_m", "m", computed(any()),
          "height at which it hangs, up from chart datum; left out: it lies on the seabed", self.up_m);
  }
  void check(const ConfigReader& from) const;
  void complete(ConfigReader&) {
    if (class_name.empty()) class_name = name;
  }
};

/// Part of the ground in which a head can see things.
struct Sector {
  std::array<double, 2> from_m{}, range_m{0.0, 0.0};
  double heading_rad = 0.0, half_angle_rad = std::numbers::pi;

  static void parameters(auto& self, auto&& visit) {
    visit("from_m", "m", in(-kFarAway_m, kFarAway_m), "east, north of the head", self.from_m);
    visit("range_m", "m", must(in(0, kFarAway_m)), "horizontal distances from it, [least, most]", self.range_m);
    visit("heading_deg", "deg", in(-360, 360), "heading of the sector's middle", self.heading_rad);
    visit("half_angle_deg", "deg", in(0, 180), "angle to either side of it", self.half_angle_rad);
  }
  void check(const ConfigReader& from) const;
};

/// Where things stand.
struct PlaceKeys {
  Drawn east_m, north_m;
  std::array<double, 2> step_m{};
  double apart_m = 2.0;
  std::optional<Sector> seen_from;
  int tries = 200;

  static void parameters(auto& self, auto&& visit) {
    visit("east_m", "m", must(any()), "place to the east", self.east_m);
    visit("north_m", "m", must(any()), "place to the north", self.north_m);
    visit("step_m", "m", in(-kFarAway_m, kFarAway_m), "east, north from one chip's place to the next one's in a scene",
          self.step_m);
    visit("apart_m", "m", in(0, kFarAway_m), "least distance between the middles of any two things of a scene",
          self.apart_m);
    visit("seen_from", "sector within which all things must stand", self.seen_from);
    visit("tries", "", in(1, 100'000), "number of tries for each thing", self.tries);
  }
};

/// A part of a sidescan's waterfall.
struct Chip {
  int width = 256, height = 256;
  double jitter = 0.25;

  static void parameters(auto& self, auto&& visit) {
    visit("width", "", in(16, 4096), "number of samples across", self.width);
    visit("height", "", in(16, 4096), "number of lines", self.height);
    visit("jitter", "", in(0, 0.5), "largest shift of the thing from the middle, of width and height", self.jitter);
  }
};

struct PictureKeys {
  std::optional<Chip> chip;
  std::string view = "polar", mask = "geometry", box = "object";
  int first_ping = 1, every = 1, least_pixels = 9;
  double white_db = -30.0, range_db = 55.0;

  static void parameters(auto& self, auto&& visit) {
    visit("chip", "part of a sidescan's waterfall about a thing; left out: whole pings of an imaging head", self.chip);
    visit("view", "", one_of({"polar", "cartesian"}), "form of whole pings: sample by beam, or a fan", self.view);
    visit("first_ping", "", in(0, 1e6), "ping of a scene's first picture", self.first_ping);
    visit("every", "", in(1, 1e6), "number of pings from one picture to the next", self.every);
    visit("least_pixels", "", in(1, 1e6), "pixels of its mask from which on a thing is labelled", self.least_pixels);
    visit("mask", "", one_of({"geometry", "response"}),
          "pixels of a thing: those that it covers, or of which it sends at least half (needs `labels: energies`)",
          self.mask);
    visit("box", "", one_of({"object", "object+shadow", "shadow"}), "part that a box goes round", self.box);
    visit("white_db", "dB", in(-200, 100), "level of white behind the gain, over the source level", self.white_db);
    visit("range_db", "dB", in(1, 200), "decibels from black to white", self.range_db);
  }
};

/// What is otherwise in a second picture of the same scene.
struct PairKeys {
  enum class Without { kNothing, kObjects, kClutter, kBoth };
  std::string name;
  static constexpr auto kNamedBy = &PairKeys::name;
  Without without = Without::kNothing;
  Drawn draw;

  bool without_objects() const { return without == Without::kObjects || without == Without::kBoth; }
  bool without_clutter() const { return without == Without::kClutter || without == Without::kBoth; }

  static void parameters(auto& self, auto&& visit) {
    visit("without", "",
          one_of({{"nothing", Without::kNothing},
                  {"objects", Without::kObjects},
                  {"clutter", Without::kClutter},
                  {"both", Without::kBoth}}),
          "things that are not there", self.without);
    visit("draw", "", computed(any()),
          "changes of the second picture as of `--set`, by KEY, each a value or a distribution", self.draw);
  }
  void check(const ConfigReader& from) const;
};

/// Shares of the scenes.
struct Splits {
  double train = 0.8, val = 0.1, test = 0.1;

  static void parameters(auto& self, auto&& visit) {
    visit("train", "", in(0, 1), "share of scenes to train on", self.train);
    visit("val", "", in(0, 1), "share of scenes to validate on", self.val);
    visit("test", "", in(0, 1), "share of scenes to test on", self.test);
  }
  void check(const ConfigReader& from) const;
};

struct Recipe {
  static constexpr const char* kFormat = "recipe/1";
  FormatKey<Recipe> format;
  std::string launch, head;
  std::uint64_t seed = 1;
  int samples = 1;
  double empty_share = 0.65;
  Drawn args, draw;
  std::vector<Kind> objects, clutter;
  std::vector<PairKeys> pairs;
  PlaceKeys place;
  PictureKeys picture;
  Splits splits;
  std::vector<std::string> formats{"coco"};

  std::string file;      // where it stands
  std::string text;      // canonical
  ConfigPlace of_place;  // of `place:`, for what cannot be drawn

  static void parameters(auto& self, auto&& visit) {
    visit("ensonify", "", must(any()), "the format", self.format);
    visit("launch", "", must(path()), "launch file of a scene; its head has `labels: masks`", self.launch);
    visit("head", "", must(not_empty()), "process whose pings become pictures", self.head);
    visit("seed", "", any(), "seed of all that is drawn", self.seed);
    visit("samples", "", in(1, 100'000), "number of pictures of a scene", self.samples);
    visit("empty_share", "", in(0, 1), "share of pictures without an object", self.empty_share);
    visit("args", "", computed(any()), "arguments of the launch file, each a value or a distribution", self.args);
    visit("draw", "", computed(any()), "changes as of `--set`, by KEY, each a value or a distribution", self.draw);
    visit("objects", "things that are labelled, by names of your own", self.objects);
    visit("clutter", "things that stand about and are not labelled", self.clutter);
    visit("pairs", "second pictures of each scene in which something is otherwise, by names of your own", self.pairs);
    visit("place", "places of things, or of the middles of empty chips", self.place);
    visit("picture", "form of a picture", self.picture);
    visit("splits", "shares of the scenes: a scene is on one side as a whole", self.splits);
    visit("formats", "", any(), "formats of labels: masks, coco, yolo, voc, webdataset", self.formats);
  }
  void check(const ConfigReader& from) const;

  /// In the order of the file, each once.
  std::vector<std::string> classes() const;
};

/// Throws ConfigError with all that is wrong with it. The launch file is found, and not read.
Recipe read_recipe(const std::string& file);
Recipe read_recipe(ConfigDocument document, const std::string& file);

}  // namespace ensonify::dataset
