#include "components/config/config_reader.h"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <functional>

#include "components/config/config_text.h"
#include "components/config/parse_yaml.h"
#include "components/errors/nearest_name.h"

namespace ensonify {
namespace {

/// The problems found when `read` reads `text`, one line each; "" when there are none.
std::string problems_of(const std::string& text, const std::function<void(ConfigReader&)>& read) {
  try {
    ConfigReader from = ConfigReader::from_text(text, "head.yaml");
    read(from);
    from.finish();
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

struct Head {
  double frequency_hz = 300e3;
  double pulse_length_s = 1e-4;
};

void read_head(ConfigReader& from) {
  Head head;
  from.required("frequency_hz", head.frequency_hz, 100e3, 1e6);
  from.optional("pulse_length_s", head.pulse_length_s, 1e-6, 1e-2);
}

}  // namespace

TEST_CASE("every problem of a file is reported at once, with place, key and what is allowed") {
  CHECK(problems_of("frequency_hz: 50000\npulse_lenght_s: 1e-4\n", read_head) ==
        "head.yaml:1:15: frequency_hz: 50000 is outside [100000, 1e+06]\n"
        "head.yaml:2:1: pulse_lenght_s: is not a known key; did you mean pulse_length_s?");
}

TEST_CASE("each kind of mistake in a number has its own words") {
  CHECK(problems_of("pulse_length_s: 1e-4", read_head) ==
        "head.yaml:1:1: frequency_hz: is missing; allowed: a number in [100000, 1e+06]");
  CHECK(problems_of("frequency_hz: fast", read_head) ==
        "head.yaml:1:15: frequency_hz: is \"fast\", not a number in [100000, 1e+06]");
  CHECK(problems_of("frequency_hz: \"200e3\"", read_head) ==
        "head.yaml:1:15: frequency_hz: is \"200e3\", not a number in [100000, 1e+06]");
  CHECK(problems_of("frequency_hz: .nan", read_head) ==
        "head.yaml:1:15: frequency_hz: .nan is not finite; allowed: a number in [100000, 1e+06]");
  CHECK(problems_of("frequency_hz: 1e999", read_head) ==
        "head.yaml:1:15: frequency_hz: 1e999 is not finite; allowed: a number in [100000, 1e+06]");
  CHECK(problems_of("frequency_hz:", read_head) ==
        "head.yaml:1:1: frequency_hz: has no value; allowed: a number in [100000, 1e+06]");
  CHECK(problems_of("frequency_hz: [1, 2]", read_head) ==
        "head.yaml:1:15: frequency_hz: is a list, not a number in [100000, 1e+06]");
  CHECK(problems_of("frequency_hz: 2e5\nfrequency_hz: 3e5", read_head) ==
        "head.yaml:2:1: frequency_hz: is given twice, first on line 1");
  CHECK(problems_of("frequency_hz: 2e5\nzzz: 3e5", read_head) ==
        "head.yaml:2:1: zzz: is not a known key; known keys: frequency_hz, pulse_length_s");
}

TEST_CASE("values of every type arrive, absent ones keep the initialiser") {
  auto from = ConfigReader::from_text(
      "real: 1.5\nsingle: .5\nwhole: -3\nseed: 18446744073709551615\nhex: 0xff\nyes: true\nname: bow\nnumber_as_name: "
      "7\n"
      "position_m: [1, 2.5, -3]\nlayers: [1e3, 2]\nwords: [a, b]\nheading_deg: 90\nspeed_kn: 10\nkind: raster\n",
      "x.yaml");
  double real = 0, absent = 42, heading_rad = 0, speed_mps = 0;
  float single = 0;
  int whole = 0, hex = 0;
  std::uint64_t seed = 0;
  bool yes = false;
  std::string name, number_as_name;
  std::array<double, 3> position_m{};
  std::vector<double> layers;
  std::vector<std::string> words;
  std::optional<double> given, not_given;
  enum class Kind { kSynthetic, kRaster } kind = Kind::kSynthetic;
  from.required("real", real);
  from.required("single", single, 0, 1.0);
  from.required("whole", whole, -3, 3);
  from.required("hex", hex);
  from.required("seed", seed);
  from.required("yes", yes);
  from.required("name", name);
  from.required("number_as_name", number_as_name);
  from.required("position_m", position_m, -10, 10);
  from.required("layers", layers);
  from.required("words", words);
  from.required("heading_deg", heading_rad, -180, 360, kDegrees);
  from.required("speed_kn", speed_mps, 0, 20, kKnots);
  from.required_choice("kind", kind, {{"synthetic", Kind::kSynthetic}, {"raster", Kind::kRaster}});
  from.optional("absent", absent, 0, 1);
  from.optional("real", given, 0, 2);
  from.optional("not_given", not_given);
  from.finish();
  CHECK(real == 1.5);
  CHECK(single == 0.5F);
  CHECK(whole == -3);
  CHECK(hex == 255);
  CHECK(seed == 18446744073709551615ULL);
  CHECK(yes);
  CHECK(name == "bow");
  CHECK(number_as_name == "7");
  CHECK(position_m == std::array{1.0, 2.5, -3.0});
  CHECK(layers == std::vector{1e3, 2.0});
  CHECK(words == std::vector<std::string>{"a", "b"});
  CHECK(heading_rad == Approx(1.5707963267948966));
  CHECK(speed_mps == Approx(5.144444));
  CHECK(kind == Kind::kRaster);
  CHECK(absent == 42);
  CHECK(given == 1.5);
  CHECK_FALSE(not_given.has_value());
}

TEST_CASE("mistakes in other types") {
  const auto with = [](auto value, const std::string& text) {
    return problems_of("a: " + text, [&](ConfigReader& from) { from.required("a", value); });
  };
  CHECK(with(0, "1.5") == "head.yaml:1:4: a: is \"1.5\", not a whole number in [-2147483648, 2147483647]");
  CHECK(with(0, "3000000000") == "head.yaml:1:4: a: 3000000000 is outside [-2147483648, 2147483647]");
  CHECK(with(std::uint64_t{0}, "-1") == "head.yaml:1:4: a: is \"-1\", not a whole number from 0 to 2^64 - 1");
  CHECK(with(false, "yes") == "head.yaml:1:4: a: is \"yes\", not true or false");
  CHECK(with(std::string{}, "[x]") == "head.yaml:1:4: a: is a list, not text");
  CHECK(with(std::array<double, 3>{}, "[1, 2]") == "head.yaml:1:4: a: has 2 values, not a list of 3 numbers");
  CHECK(with(std::array<double, 2>{}, "[1, up]") == "head.yaml:1:8: a[1]: is \"up\", not a number");
  CHECK(with(std::vector<std::string>{}, "[{}, b]") == "head.yaml:1:5: a[0]: is a map of keys, not text");
  CHECK(problems_of("a: rastr", [](ConfigReader& from) {
          int kind = 0;
          from.required_choice("a", kind, {{"synthetic", 0}, {"raster", 1}});
        }) == "head.yaml:1:4: a: is \"rastr\", not one of synthetic, raster");
  CHECK(
      problems_of("a: missing.tif",
                  [](ConfigReader& from) {
                    std::string path;
                    from.required_path("a", path);
                  }) ==
      "head.yaml:1:4: a: \"missing.tif\": no such file or folder (searched beside this file and in the data folders)");
}

TEST_CASE("sections, lists and named sections report the path of their keys") {
  const auto read = [](ConfigReader& from) {
    double x = 0;
    from.section("mounting").required("x_m", x, -5, 5);
    if (auto extra = from.optional_section("extra")) {
      extra->required("x_m", x);
    }
    for (auto& line : from.list("runlines")) {
      line.required("from_m", x);
    }
    for (auto& [name, vehicle] : from.named_sections("vehicles")) {
      vehicle.required("speed_mps", x, 0.0, 20);
    }
  };
  CHECK(
      problems_of("mounting: {x_m: 9, y_m: 1}\nrunlines:\n  - {from_m: 1}\n  - {}\nvehicles:\n  auv: {speed_mps: -1}\n"
                  "  usv: 3\n",
                  read) ==
      "head.yaml:1:17: mounting.x_m: 9 is outside [-5, 5]\n"
      "head.yaml:1:20: mounting.y_m: is not a known key; did you mean x_m?\n"
      "head.yaml:4:5: runlines[1].from_m: is missing; allowed: a number\n"
      "head.yaml:6:20: vehicles.auv.speed_mps: -1 is outside [0, 20]\n"
      "head.yaml:7:8: vehicles.usv: is \"3\", not a map of keys");
  CHECK(problems_of("runlines: 5", read) ==
        "head.yaml:1:1: mounting: is missing; allowed: a map of keys\n"
        "head.yaml:1:11: runlines: is \"5\", not a list");
}

TEST_CASE("the caller's own checks and a second document land in the same list") {
  auto from = ConfigReader::from_text("start: 3\nend: 1\n", "a.yaml");
  double start = 0, end = 0;
  from.required("start", start);
  from.required("end", end);
  from.problem("end", "is before start");
  auto other = from.also(parse_config("speed: x", "b.yaml"));
  other.required("speed", start);
  CHECK_FALSE(from.good());
  CHECK_NOTHROW(other.finish());
  CHECK_THROWS_WITH(from.finish(),
                    "a.yaml:2:6: end: is before start\n"
                    "b.yaml:1:8: speed: is \"x\", not a number");
}

TEST_CASE("what is no map of keys is refused with a place") {
  const auto parsed = [](const std::string& text) { return problems_of(text, [](ConfigReader&) {}); };
  CHECK(parsed("") == "head.yaml:1:1: is empty; a map of keys is expected");
  CHECK(parsed("# nothing\n") == "head.yaml:1:1: is empty; a map of keys is expected");
  CHECK(parsed("- a\n- b\n") == "head.yaml:1:1: is not a map of keys");
  CHECK(parsed("just text") == "head.yaml:1:1: is not a map of keys");
  CHECK(parsed("{a: 1}\n---\nb: 2\n") == "head.yaml:3:1: a second document begins; one is allowed");
  CHECK(parsed("a: [1, 2\nb: 3\n").find("head.yaml:2:") == 0);
  CHECK(parsed("a: b: c").find("head.yaml:1:5: is not YAML: ") == 0);
  CHECK(parsed("[1]: 2") == "head.yaml:1:1: a key must be a word; is a bracket left open?");
  CHECK(parsed(std::string("a: \0b", 5)).find("head.yaml:") == 0);
}

TEST_CASE("missing files, folders and huge files are ConfigErrors") {
  CHECK_THROWS_WITH(ConfigReader::from_file("no/such.yaml"), "no/such.yaml: no such file");
  CHECK_THROWS_WITH(ConfigReader::from_file("/tmp"), "/tmp: is a folder; a YAML file is expected");
  const std::string pipe = "/tmp/ensonify_config_pipe_" + std::to_string(::getpid());
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);  // opening it would wait for a writer, for ever
  CHECK_THROWS_WITH(ConfigReader::from_file(pipe), pipe + ": is a named pipe; a YAML file is expected");
  std::remove(pipe.c_str());
}

TEST_CASE("deep nesting and alias bombs end in an error, not in a crash") {
  const auto parsed = [](const std::string& text) { return problems_of(text, [](ConfigReader&) {}); };
  CHECK(parsed("a: " + std::string(100000, '[') + std::string(100000, ']')).find("levels of nesting") !=
        std::string::npos);
  CHECK(parsed("a: " + std::string(100000, '[')).find("is a bracket left open?") != std::string::npos);
  CHECK(parsed("a: " + std::string(99, '[') + std::string(99, ']')).find("is not a known key") != std::string::npos);
  std::string block;
  for (int i = 0; i < 5000; ++i) {
    block += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  }
  CHECK(parsed(block).find("levels of nesting") != std::string::npos);

  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
    for (int n = 1; n < 10; ++n) {
      bomb += ", " + last;
    }
    bomb += "]\n";
  }
  CHECK(parsed(bomb).find("the document grows beyond 200000 values") != std::string::npos);

  std::string ladder = "a0: &a0 [x]\n";  // one level deeper with every alias
  for (int i = 1; i < 1000; ++i) {
    ladder += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + std::to_string(i - 1) + "]\n";
  }
  CHECK(parsed(ladder).find("more than 200 levels of nesting") != std::string::npos);
  CHECK(parsed("a: &a [*a]").find("head.yaml:1:8: ") == 0);
}

TEST_CASE("an alias gives the anchored value again") {
  auto from = ConfigReader::from_text("one: &m {x: 1}\ntwo: *m\n", "a.yaml");
  double x = 0;
  from.section("one").required("x", x);
  from.section("two").required("x", x);
  from.finish();
  CHECK(x == 1);
}

TEST_CASE("command line values are checked like the file's and named by their option") {
  ConfigDocument document = parse_config("frequency_hz: 200e3\nlist: [{x: 1}]\n", "head.yaml");
  const auto set = [&](const std::string& path, const std::string& value) {
    return set_config_value(document.root, path, parse_config_value(value, {"--set bow." + path}));
  };
  CHECK(set("frequency_hz", "50000") == "");
  CHECK(set("gian_db", "3") == "");
  CHECK(set("list.0.x", "up") == "");
  CHECK(set("list.1.x", "2") == "the list has 1 values; counted from 0");
  CHECK(set("list.x", "2") == "\"x\" does not count the values of a list");
  CHECK(set("frequency_hz.x", "2") == "\"50000\" holds no keys");
  CHECK(set("a..b", "2") == "\"a..b\" is not a path of keys with dots between them");
  ConfigReader from(document, "processes.bow.config");
  Head head;
  double gain_db = 0;
  from.required("frequency_hz", head.frequency_hz, 100e3, 1e6);
  from.optional("gain_db", gain_db);
  from.list("list")[0].required("x", gain_db);
  CHECK_THROWS_WITH(from.finish(),
                    "--set bow.frequency_hz: 50000 is outside [100000, 1e+06]\n"
                    "--set bow.gian_db: is not a known key; did you mean gain_db?\n"
                    "--set bow.list.0.x: is \"up\", not a number");
  CHECK_THROWS_WITH(parse_config_value("[1, 2", {"--set a.b"}),
                    "--set a.b: a key must be a word; is a bracket left open?");
}

TEST_CASE("a tree becomes JSON with types and canonical YAML without absolute paths") {
  const ConfigNode root =
      parse_config(
          "a: 1\nb: [true, null, 'x\"y', \"5\", 1e3, .inf]\nc: {}\nfile: /home/me/data/bay.tif\nm:\n  - {k: v}\n",
          "x.yaml")
          .root;
  CHECK(to_json(root) ==
        R"({"a":1,"b":[true,null,"x\"y","5",1000,".inf"],"c":{},"file":"/home/me/data/bay.tif","m":[{"k":"v"}]})");
  CHECK(to_canonical_yaml(root) ==
        "a: 1\nb:\n  - true\n  - null\n  - \"x\\\"y\"\n  - \"5\"\n  - 1e3\n  - .inf\nc: {}\nfile: bay.tif\nm:\n  -\n"
        "    k: v\n");
  CHECK(to_json(parse_config(to_canonical_yaml(root), "y.yaml").root.find("b")[0]) ==
        R"([true,null,"x\"y","5",1000,".inf"])");
}

TEST_CASE("names are found again after slips of the fingers, and only then") {
  CHECK(nearest_name("agent/comand", {"agent/command", "auv/pose"}) == "agent/command");
  CHECK(nearest_name("frqeuency", {"frequency"}) == "frequency");
  CHECK(nearest_name("zebra", {"frequency", "pulse"}) == "");
}

TEST_CASE("a record's text keeps apart what YAML would read as nothing or as a truth value") {
  const ConfigNode root = parse_config("a: \"NULL\"\nb: Off\nc: \"off\"\n\"Null\": \"~\"\non: null\n", "a.yaml").root;
  const std::string text = to_canonical_yaml(root);
  CHECK(text == "a: \"NULL\"\nb: Off\nc: \"off\"\n\"Null\": \"~\"\non: null\n");
  CHECK(to_canonical_yaml(parse_config(text, "b.yaml").root) == text);
}

TEST_CASE("bytes that are not UTF-8 are refused with their place") {
  CHECK_THROWS_WITH(parse_config("a: 1\nb: \"x\xff\"\n", "a.yaml"), "a.yaml:2:4: is not UTF-8");
  CHECK_THROWS_WITH(parse_config("a: 1\n\"b\xff\": 1\n", "a.yaml"), "a.yaml:2:1: is not UTF-8");
}

}  // namespace ensonify
