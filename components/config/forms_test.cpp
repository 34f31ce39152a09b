/// What files do beside plain values: one of several forms, a word or a map, a value that is short for a map, maps by
/// number, lists of whole numbers, a second key of a member.
#include <catch2/catch.hpp>
#include <map>
#include <variant>

#include "components/config/parameter_info.h"
#include "components/config/read_parameters.h"

namespace ensonify {
namespace {

struct Cast {
  static constexpr const char* kShort = "file";
  std::string file, column = "depth_m";

  static void parameters(auto& self, auto&& visit) {
    visit("file", "", must(any()), "a text file", self.file);
    visit("column", "", any(), "what the column is called", self.column);
  }
};

struct Wall {
  double row_m = 1.0;
  static void parameters(auto& self, auto&& visit) { visit("row_m", "m", must(in(0, 10)), "a wall", self.row_m); }
};
struct Bars {
  int bars = 0;
  double tilt_rad = 0.0;
  static void parameters(auto& self, auto&& visit) {
    visit("bars", "", must(in(1, 10)), "number of bars", self.bars);
    visit("tilt_deg", "deg", in(0, 90), "how far they lean", self.tilt_rad);
  }
};
struct Post {
  double post_m = 0.0, tilt_rad = 0.0;
  static void parameters(auto& self, auto&& visit) {
    visit("post_m", "m", must(in(0, 10)), "one post", self.post_m);
    visit("tilt_deg", "deg", in(0, 90), "how far they lean", self.tilt_rad);
  }
};
struct Fence {
  std::variant<Bars, Post> of;
  static void parameters(auto& self, auto&& visit) { visit(one_form(), self.of); }
};
struct Nothing {
  static void parameters(auto&, auto&&) {}
};

struct Start {
  double speed_mps = 0.0;
  static void parameters(auto& self, auto&& visit) {
    visit("speed_mps", "m/s", in(0, 30), "speed there", self.speed_mps);
  }
};

struct Rest {
  std::optional<double> for_s;
  static void parameters(auto& self, auto&& visit) { visit("for_s", "s", any(), "how long", self.for_s); }
};
struct Stop {
  Rest rest;
  static void parameters(auto& self, auto&& visit) { visit("rest", "", must(any()), "what is done there", self.rest); }
};

struct Mask {
  double scale_m = 2.0;
  std::vector<Mask> any_of;
  static void parameters(auto& self, auto&& visit) {
    visit("scale_m", "m", in(0, 10), "of the mask", self.scale_m);
    visit("any_of", "masks of which one holds", self.any_of);
  }
};

struct Drawn {
  static constexpr const char* kWord = "drawn";
  double size_m = 10.0;
  static void parameters(auto& self, auto&& visit) { visit("size_m", "m", in(0, 100), "its side", self.size_m); }
};
struct Imported {
  static constexpr const char* kWord = "imported";
  std::string raster;
  static void parameters(auto& self, auto&& visit) { visit("raster", "", must(any()), "a file", self.raster); }
};

struct Site {
  std::variant<Drawn, Imported> ground;
  std::optional<Cast> cast;
  std::variant<Wall, Bars> stands;
  std::vector<std::variant<Wall, Bars, Start>> steps;
  std::map<std::uint8_t, Start> classes = {{0, Start{1.0}}};
  std::map<std::string, Cast> casts;
  std::map<std::string, Stop> stops;
  std::optional<double> rate;
  std::optional<Start> start;
  std::vector<std::uint8_t> on;
  double speed_mps = 2.0;
  double height_m = 0.5;
  Mask mask;

  static void parameters(auto& self, auto&& visit) {
    visit("cast", "a measured profile", self.cast);
    visit(form_by("kind", "where the ground is from", "is not of this kind"), self.ground);
    visit(one_form("needs one of {}"), self.stands);
    visit("steps", "in their order", self.steps);
    visit("classes", "", called("a class", in(0, 255)), "by number", self.classes);
    visit("casts", "by names", self.casts);
    visit("stops", "by names", self.stops);
    visit("rate", "", or_word("free", in(1, 10)), "pace", self.rate);
    visit("start", "", or_word("anywhere"), "where it starts", self.start);
    visit("on", "", called("a class", in(0, 255)), "classes", self.on);
    visit("speed_mps", "m/s", in(0, 30), "speed", self.speed_mps);
    visit("speed_kn", "kn", again(in(0, 58)), "instead of speed_mps", self.speed_mps);
    visit("height_m", "m", computed(in(0, 1)), "left out: 0.5", self.height_m);
    visit("mask", "where", self.mask);
  }
};

struct Read {
  Site site;
  std::string written;
};

Read read(const std::string& text) {
  Read read;
  ConfigReader from = ConfigReader::from_text(text, "site.yaml");
  read_parameters(from, read.site);
  from.finish();
  read.written = written_yaml(parameters_of(read.site, &from.node()));
  return read;
}

std::string problems_of(const std::string& text) {
  try {
    read(text);
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("what is written of values reads as the same values, for each form") {
  for (const char* text :
       {"row_m: 3", "bars: 3\ntilt_deg: 7.1", "bars: 3\ncast: x.csv", "row_m: 3\nkind: imported\nraster: x.tif",
        "row_m: 3\nkind: drawn\nsize_m: 7", "row_m: 3\ncast: {file: x.csv, column: z}",
        "row_m: 3\nsteps: [{row_m: 1}, {speed_mps: 0.1}, {}]", "row_m: 3\nsteps: []",
        R"(row_m: 3
casts: {"no": "NULL", "Null": "~", "On": {file: "off", column: "Yes"}, "TRUE": "null"})",
        "row_m: 3\nclasses: {7: {speed_mps: 3}, 0: {}}", "row_m: 3\ncasts: {a b: x, c: {file: y}}",
        "row_m: 3\nstops: {a: {rest: {}}, b: {rest: {for_s: 1}}}", "row_m: 3\nrate: free\nstart: anywhere",
        "row_m: 3\nrate: 2\nstart: {}", "row_m: 3\nstart: {speed_mps: 1}\non: [0, 255]", "row_m: 3\nspeed_kn: 3",
        "row_m: 3\nheight_m: 0.5",
        "row_m: 3\nmask: {any_of: [{any_of: [{any_of: [{any_of: [{scale_m: 1}]}]}]}, {}]}"}) {
    const Read once = read(text);
    INFO(text << "\n" << once.written);
    const Read again = read(once.written);
    CHECK(equal_parameters(once.site, again.site));
    CHECK(once.written == again.written);
  }
}

TEST_CASE("every value is written with sentence and unit, and nothing that has none") {
  CHECK(read("bars: 2\nspeed_kn: 3.6\ncast: x.csv\nsteps: [{row_m: 1}]").written ==
        R"(cast:              # a measured profile
  file: x.csv      # a text file
  column: depth_m  # what the column is called
kind: drawn        # where the ground is from
size_m: 10         # its side (m)
bars: 2            # number of bars
tilt_deg: 0        # how far they lean (deg)
steps:             # in their order
  - row_m: 1       # a wall (m)
classes:           # by number
  0:
    speed_mps: 1   # speed there (m/s)
rate: free         # pace
start: anywhere    # where it starts
on: []             # classes
speed_mps: 1.852   # speed (m/s)
mask:              # where
  scale_m: 2       # of the mask (m)
)");
}

TEST_CASE("a text that YAML reads as nothing or a truth value is written in quotes, as a key too") {
  const std::string written = read("row_m: 3\ncasts: {\"no\": \"NULL\", a: \"Off\"}").written;
  INFO(written);
  CHECK(written.find("\n  \"no\":\n    file: \"NULL\"") != std::string::npos);
  CHECK(written.find("\n  a:\n    file: \"Off\"") != std::string::npos);
}

TEST_CASE("a table says of a form's keys that the form has them, and has no row twice") {
  const std::string table = parameter_table(parameters_of<Site>());
  INFO(table);
  CHECK(table.find("| `row_m` | m | of its form |") != std::string::npos);
  CHECK(table.find("| `cast.file` |  | required |") != std::string::npos);
  const std::string fence = parameter_table(parameters_of<Fence>()), row = "| `tilt_deg` |";  // both forms have it
  CHECK(fence.find(row) != std::string::npos);
  CHECK(fence.find(row) == fence.rfind(row));
}

TEST_CASE("a wrong form is named with its place and what is allowed") {
  CHECK(problems_of("speed_mps: 1") == "site.yaml:1:1: needs one of row_m, bars");
  CHECK(problems_of("row_m: 1\nbars: 1") == "site.yaml:2:7: bars: stands beside row_m; give one or the other");
  CHECK_THAT(problems_of("row_m: 1\ntilt_deg: 1"),
             Catch::StartsWith("site.yaml:2:1: tilt_deg: is not a known key; known keys: bars, cast"));
  CHECK(problems_of("row_m: 1\nraster: x") == "site.yaml:2:9: raster: is not of this kind");
  CHECK(problems_of("row_m: 1\nkind: imported") == "site.yaml:1:1: raster: is missing; allowed: text");
  CHECK(problems_of("row_m: 1\nkind: dawn") == "site.yaml:2:7: kind: is \"dawn\", not one of drawn, imported");
  CHECK(problems_of("row_m: 1\nclasses: {256: {}}") ==
        "site.yaml:2:16: classes.256: is not a class, a whole number in [0, 255]");
  CHECK(problems_of("row_m: 1\nclasses: {sand: {}}") ==
        "site.yaml:2:17: classes.sand: is not a class, a whole number in [0, 255]");
  CHECK(problems_of("row_m: 1\non: [1.5]") == "site.yaml:2:5: on: holds a number that is not a class, a whole number");
  CHECK(problems_of("row_m: 1\non: [256]") == "site.yaml:2:6: on[0]: 256 is outside [0, 255]");
  CHECK(problems_of("row_m: 1\nrate: fast") == "site.yaml:2:7: rate: is \"fast\", not a number in [1, 10]");
  CHECK(problems_of("row_m: 1\nstart: here") == "site.yaml:2:8: start: is neither anywhere nor a map of speed_mps");
  CHECK(problems_of("row_m: 1\ncast: {column: z}") == "site.yaml:2:7: cast.file: is missing; allowed: text");
  CHECK(problems_of("row_m: 1\nclasses: {0: }") == "site.yaml:2:11: classes.0: has no value; allowed: a map of keys");
  CHECK(problems_of("row_m: 1\ncasts: {a: }") == "site.yaml:2:9: casts.a: has no value; allowed: a map of keys");
  CHECK(problems_of("row_m: 1\nsteps: [null]") == "site.yaml:2:9: steps[0]: has no value; allowed: a map of keys");
  CHECK(problems_of("row_m: 1\ncast: [x]") == "site.yaml:2:7: cast: is a list, not a map of keys");
  CHECK(problems_of("row_m: 1\nsteps: [{bars: 1, row_m: 2}]") ==
        "site.yaml:2:16: steps[0].bars: stands beside row_m; give one or the other");
  CHECK(problems_of("row_m: 1\nsteps: [{row_m: 1, speed_mps: 1}]") ==
        "site.yaml:2:20: steps[0].speed_mps: is not a known key; known keys: bars, row_m");
}

TEST_CASE("a schema has the forms: one of several, a word or a map, a value or a map") {
  const std::string schema = parameter_schema("site", parameters_of<Site>());
  INFO(schema);
  const auto holds = [&](const std::string& text) {
    std::string plain;
    for (const char c : schema) {
      if (c != ' ' && c != '\n') plain += c;
    }
    return plain.find(text) != std::string::npos;
  };
  CHECK(holds(R"("oneOf":[{"required":["row_m"],"properties":{"tilt_deg":false}},{"required":["bars"]}])"));
  CHECK(holds(R"({"properties":{"kind":{"const":"imported"},"size_m":false},"required":["kind","raster"]})"));
  CHECK(holds(R"("start":{"anyOf":[{"const":"anywhere"},{"type":"object","additionalProperties":false)"));
  CHECK(holds(R"("cast":{"anyOf":[{"type":["string","number","boolean"]},{"type":"object")"));
  CHECK(holds(R"("propertyNames":{"pattern":"^[0-9]+$"})"));
  CHECK(holds(R"("on":{"type":"array","items":{"type":"integer","minimum":0.0,"maximum":255.0})"));
}

TEST_CASE("a shipped schema has what stands in several places once; sentence and default stay where it is used") {
  const std::string part =
      R"({"type": "array", "items": {"type": "number", "minimum": 0, "maximum": 255}, "minItems": 2})";
  const std::string with = part.substr(0, part.size() - 1);
  CHECK(schema_text(R"({"properties": {"a": )" + with + R"(, "description": "one"}, "b": )" + with +
                    R"(, "description": "two", "default": [1, 2]}, "c": {"type": "number", "description": "three"}, )" +
                    R"("d": {"anyOf": [{"$ref": "#/$defs/own"}, )" + part +
                    R"(]}}, "$defs": {"own": {"enum": ["x"]}}})") ==
        R"({
 "properties": {
  "a": {"$ref":"#/$defs/a","description":"one"},
  "b": {"$ref":"#/$defs/a","description":"two","default":[1,2]},
  "c": {"type":"number","description":"three"},
  "d": {"anyOf":[{"$ref":"#/$defs/own"},{"$ref":"#/$defs/a"}]}
 },
 "$defs": {"own":{"enum":["x"]},"a":{"type":"array","items":{"type":"number","minimum":0,"maximum":255},"minItems":2}}
}
)");
}

}  // namespace ensonify
