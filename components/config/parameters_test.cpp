#include "components/config/parameters.h"

#include <catch2/catch.hpp>

#include "components/config/parameter_info.h"
#include "components/config/read_parameters.h"

namespace ensonify {
namespace {

/// A struct that knows nothing of files, as those of kernels.
struct Window {
  double level_db = 30.0;
};

struct Line {
  std::string name = "main";
  double width_rad = 0.4 * (3.14159265358979323846 / 180.0);
  std::optional<double> tilt_rad;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("name", "", must(not_empty()), "its port is ping_NAME", self.name);
    visit("width_deg", "deg", in(0.05, 10), "width of the beam", self.width_rad);
    visit("tilt_deg", "deg", in(-90, 90), "down; left out, none", self.tilt_rad);
  }
};

struct Neighbour {
  static constexpr double kDeaf_db = 300.0;
  std::string process;
  double isolation_db = 40.0;
  static constexpr auto kNamedBy = &Neighbour::process;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("isolation_db", "dB", in(0, kDeaf_db), "of its source level", self.isolation_db);
  }
};

struct Range {
  double shortest_m = 1.0;
  double longest_m = 100.0;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("shortest_m", "m", in(0, 1000), "nearer is not measured", self.shortest_m);
    visit("longest_m", "m", in(0, 1000), "farther is not measured", self.longest_m);
  }
  void check(const ConfigReader& from) const {
    if (shortest_m >= longest_m) from.problem("shortest_m", "is not below longest_m");
  }
};

struct Head {
  enum class Spacing { kEven, kDense };
  double frequency_hz = 300e3;
  double swath_rad = 130.0 * (3.14159265358979323846 / 180.0);
  double absorption_dbpm = 0.07;
  float share = 0.5F;
  int beams = 256;
  std::uint64_t seed = 1;
  bool published = false;
  bool chirp = false;
  Spacing spacing = Spacing::kEven;
  std::string mode = "bathymetry";
  std::string title = "bow 1";
  std::array<double, 3> position_m{0.005, 0.0, -2.0};
  std::vector<double> layers_m;
  std::vector<std::string> words{"a", "7"};
  std::vector<std::array<double, 2>> places_m{{1.0, 2.0}};
  Window window;
  Range range;
  std::optional<Range> second_range;
  std::vector<Line> lines{Line{}};
  std::vector<Line> spare_lines;
  std::vector<Neighbour> neighbours;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("frequency_hz", "Hz", in(50e3, 1e6), "centre frequency", self.frequency_hz);
    visit("swath_deg", "deg", in(1, 170), "width of the swath", self.swath_rad);
    visit("absorption_db_per_km", "dB/km", in(0, 2000), "of the gain", self.absorption_dbpm);
    visit("share", "", in(0, 1), "of the swath", self.share);
    visit("beams", "", in(2, 1024), "number of beams", self.beams);
    visit("seed", "", any(), "of the noise", self.seed);
    visit("published", "", any(), "whether it is sent", self.published);
    visit("pulse", "", one_of({{"tone", false}, {"chirp", true}}), "kind of pulse", self.chirp);
    visit("spacing", "", one_of({{"even", Spacing::kEven}, {"dense", Spacing::kDense}}), "of beams", self.spacing);
    visit("mode", "", one_of({"bathymetry", "water_column"}), "what is sent", self.mode);
    visit("title", "", any(), "for people", self.title);
    visit("position_m", "m", in(-10, 10), "forward, starboard, down", self.position_m);
    visit("layers_m", "m", in(0, 100), "depths", self.layers_m);
    visit("words", "", any(), "a list | of words", self.words);
    visit("places_m", "m", in(-100, 100), "east, north", self.places_m);
    visit("window", "of the line", self.window);
    visit("range", "distances", self.range);
    visit("second_range", "more distances", self.second_range);
    visit("lines", "each frequency", self.lines);
    visit("spare_lines", "frequencies in reserve", self.spare_lines);
    visit("neighbours", "heads that are received", self.neighbours);
  }
};

}  // namespace

template <>
struct ParametersOf<Window> {
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("level_db", "dB", in(13, 100), "side lobes below the main lobe", self.level_db);
  }
  static void check(const ConfigReader& from, const Window& window) {
    if (window.level_db == 13.5) from.problem("level_db", "is 13.5");
  }
};

namespace {

std::string problems_of(const std::string& text) {
  try {
    ConfigReader from = ConfigReader::from_text(text, "head.yaml");
    Head head;
    read_parameters(from, head);
    from.finish();
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

Head read(const std::string& text) {
  ConfigReader from = ConfigReader::from_text(text, "head.yaml");
  Head head;
  read_parameters(from, head);
  from.finish();
  return head;
}

/// Every member is another than the default.
Head changed_head() {
  Head head;
  head.frequency_hz = 123456.789;
  head.swath_rad = 1.0;
  head.absorption_dbpm = 0.1 + 0.2;
  head.share = 0.3F;
  head.beams = 17;
  head.seed = 18446744073709551615ULL;
  head.published = head.chirp = true;
  head.spacing = Head::Spacing::kDense;
  head.mode = "water_column";
  head.title = "a: \"b\" # c";
  head.position_m = {1.0 / 3.0, 1e-9, -10.0};
  head.layers_m = {1.5, 99.0};
  head.words = {"true", "- x", ""};
  head.places_m = {{0.1, 0.2}, {-0.3, 1e-7}};
  head.window.level_db = 40.0;
  head.range = {2.0, 3.0};
  head.lines = {Line{"low", 0.1, 0.2}, Line{"high", 0.05, std::nullopt}};
  head.spare_lines = {Line{"spare", 0.15, -0.1}};
  head.neighbours = {{"stern", 10.0}, {"bow", 20.0}};
  return head;
}

std::string printed(const ParameterList& list) {
  std::string text;
  for (const ParameterInfo& p : list) text += p.key + "\n" + printed(p.members);
  return text;
}

}  // namespace

TEST_CASE("a default file reads as the initialisers, to the last bit") {
  CHECK(equal_parameters(read(default_yaml("head", parameters_of<Head>())), Head{}));
}

TEST_CASE("a list reads what it writes, to the last bit, with every member changed") {
  const Head changed = changed_head();
  const std::string text = default_yaml("head", parameters_of(changed));
  INFO(text);
  CHECK(equal_parameters(read(text), changed));
}

TEST_CASE("a default file holds key, value, sentence and allowed range of each parameter") {
  CHECK(default_yaml("head: every parameter", parameters_of<Head>()) == R"(# head: every parameter
frequency_hz: 300000        # centre frequency; 50000 to 1e+06
swath_deg: 130              # width of the swath; 1 to 170
absorption_db_per_km: 70    # of the gain; 0 to 2000
share: 0.5                  # of the swath; 0 to 1
beams: 256                  # number of beams; 2 to 1024
seed: 1                     # of the noise
published: false            # whether it is sent
pulse: tone                 # kind of pulse; tone or chirp
spacing: even               # of beams; even or dense
mode: bathymetry            # what is sent; bathymetry or water_column
title: "bow 1"              # for people
position_m: [0.005, 0, -2]  # forward, starboard, down; -10 to 10
layers_m: []                # depths; 0 to 100
words: [a, "7"]             # a list | of words
places_m: [[1, 2]]          # east, north; -100 to 100
window:                     # of the line
  level_db: 30              # side lobes below the main lobe; 13 to 100
range:                      # distances
  shortest_m: 1             # nearer is not measured; 0 to 1000
  longest_m: 100            # farther is not measured; 0 to 1000
# second_range:             # more distances
#   shortest_m: 1           # nearer is not measured; 0 to 1000
#   longest_m: 100          # farther is not measured; 0 to 1000
lines:                      # each frequency
  - name: main              # its port is ping_NAME; must be given
    width_deg: 0.4          # width of the beam; 0.05 to 10
#     tilt_deg:             # down; left out, none; -90 to 90
spare_lines: []             # frequencies in reserve
#   - name: main            # its port is ping_NAME; must be given
#     width_deg: 0.4        # width of the beam; 0.05 to 10
#     tilt_deg:             # down; left out, none; -90 to 90
neighbours: {}              # heads that are received
#   NAME:
#     isolation_db: 40      # of its source level; 0 to 300
)");
}

TEST_CASE("two structs are equal when every listed member is") {
  CHECK(equal_parameters(Head{}, Head{}));
  const Head changed = changed_head();
  CHECK(equal_parameters(changed, changed));
  CHECK_FALSE(equal_parameters(changed, Head{}));
  // One key at a time: a file that sets it alone makes another struct.
  for (const char* text : {"frequency_hz: 1e5",
                           "swath_deg: 1",
                           "absorption_db_per_km: 1",
                           "share: 0.25",
                           "beams: 3",
                           "seed: 2",
                           "published: true",
                           "pulse: chirp",
                           "spacing: dense",
                           "mode: water_column",
                           "title: x",
                           "position_m: [1, 2, 3]",
                           "layers_m: [1]",
                           "words: [b]",
                           "places_m: []",
                           "window: {level_db: 20}",
                           "range: {longest_m: 50}",
                           "second_range: {}",
                           "lines: []",
                           "lines: [{name: x}]",
                           "lines: [{name: main, tilt_deg: 1}]",
                           "spare_lines: [{name: x}]",
                           "neighbours: {bow: {}}"}) {
    INFO(text);
    CHECK_FALSE(equal_parameters(read(text), Head{}));
  }
  CHECK_FALSE(equal_parameters(read("neighbours: {bow: {}}"), read("neighbours: {stern: {}}")));
}

TEST_CASE("mistakes in a listed file are named with their place and what is allowed") {
  CHECK(problems_of("frequency_hz: 50\nswath_dge: 3\n") ==
        "head.yaml:1:15: frequency_hz: 50 is outside [50000, 1e+06]\n"
        "head.yaml:2:1: swath_dge: is not a known key; did you mean swath_deg?");
  CHECK(problems_of("swath_deg: 200") == "head.yaml:1:12: swath_deg: 200 is outside [1, 170]");
  CHECK(problems_of("beams: 1.5") == "head.yaml:1:8: beams: is \"1.5\", not a whole number in [2, 1024]");
  CHECK(problems_of("pulse: sweep") == "head.yaml:1:8: pulse: is \"sweep\", not one of tone, chirp");
  CHECK(problems_of("mode: x") == "head.yaml:1:7: mode: is \"x\", not one of bathymetry, water_column");
  CHECK(problems_of("lines: [{width_deg: 1}]") == "head.yaml:1:9: lines[0].name: is missing; allowed: text");
  CHECK(problems_of("lines: [{name: \"\"}]") == "head.yaml:1:16: lines[0].name: is empty; allowed: a text");
  CHECK(problems_of("neighbours: {bow: {isolation_db: -1}}") ==
        "head.yaml:1:34: neighbours.bow.isolation_db: -1 is outside [0, 300]");
  CHECK(problems_of("range: {shortest_m: 200}") == "head.yaml:1:21: range.shortest_m: is not below longest_m");
  CHECK(problems_of("window: {level_db: 13.5}") == "head.yaml:1:20: window.level_db: is 13.5");
  CHECK(problems_of("range: 7") == "head.yaml:1:8: range: is \"7\", not a map of keys");
}

TEST_CASE("a value with a problem leaves an optional parameter unset") {
  ConfigReader from = ConfigReader::from_text("name: x\ntilt_deg: 91\n", "line.yaml");
  Line line;
  read_parameters(from, line);
  CHECK_FALSE(line.tilt_rad.has_value());
  CHECK_THROWS_WITH(from.finish(), "line.yaml:2:11: tilt_deg: 91 is outside [-90, 90]");
}

TEST_CASE("default file, table and schema show each key of the list") {
  const ParameterList list = parameters_of<Head>();
  const std::string yaml = default_yaml("head", list), table = parameter_table(list);
  const std::string schema = parameter_schema("head", list);
  const std::string keys = printed(list);
  for (std::size_t at = 0, end = 0; (end = keys.find('\n', at)) != std::string::npos; at = end + 1) {
    const std::string key = keys.substr(at, end - at);
    INFO(key);
    CHECK(yaml.find(key + ":") != std::string::npos);
    CHECK((table.find("`" + key + "`") != std::string::npos || table.find("." + key + "`") != std::string::npos));
    CHECK(schema.find("\"" + key + "\": {") != std::string::npos);
  }
}

TEST_CASE("a table has unit, default and range in columns, and sections as paths") {
  const std::string table = parameter_table(parameters_of<Head>());
  CHECK(table.find("| `swath_deg` | deg | `130` | 1 to 170 | width of the swath |\n") != std::string::npos);
  CHECK(table.find("| `lines[].name` |  | required |  | its port is ping_NAME |\n") != std::string::npos);
  CHECK(table.find("| `neighbours.NAME.isolation_db` | dB | `40` | 0 to 300 |") != std::string::npos);
  CHECK(table.find("| a list \\| of words |\n") != std::string::npos);
}

TEST_CASE("a schema has type, limits, default and sentence, and refuses unknown keys") {
  const std::string schema = parameter_schema("head", parameters_of<Range>());
  CHECK(schema == R"json({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "head",
  "type": "object",
  "additionalProperties": false,
  "properties": {
    "shortest_m": {
      "type": "number",
      "minimum": 0.0,
      "maximum": 1000.0,
      "description": "nearer is not measured (m)",
      "default": 1
    },
    "longest_m": {
      "type": "number",
      "minimum": 0.0,
      "maximum": 1000.0,
      "description": "farther is not measured (m)",
      "default": 100
    }
  }
}
)json");
}

TEST_CASE("an unknown unit in a list is a mistake of ours") {
  CHECK_THROWS_WITH(file_unit("furlong"), Catch::Contains("furlong is no unit"));
  CHECK(file_unit("deg") == kDegrees.si);
}

}  // namespace ensonify
