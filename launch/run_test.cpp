// What launch files say is done, and the tools of this folder. What a run survives, and what it says when it does not:
// tests/system/faults_test.py.
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "launch/child.h"

namespace ensonify::launcher {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) { return tail(file.string(), 100000); }

/// A folder with launch files, results and the sockets' folder of the runs in it.
class Workplace {
 public:
  Workplace() {
    std::string name = (fs::temp_directory_path() / "run_test_XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
    ::setenv("XDG_RUNTIME_DIR", path_.c_str(), 1);
  }
  ~Workplace() {
    ::unsetenv("XDG_RUNTIME_DIR");
    std::error_code error;
    fs::remove_all(path_, error);
  }

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }

  /// Two stubs, a to b; `rest` stands behind the processes, `for_a` among the parameters of a.
  void two_stubs(const std::string& rest = "", const std::string& for_a = "") const {
    write("x.yaml",
          "ensonify: launch/1\nprocesses:\n"
          "  a: {run: stub, config: {out: [{port: x, type: x/1, hz: 100}], rate_hz: 100" +
              for_a + "}}\n  b: {run: stub, config: {in: [{port: x, type: x/1}]}}\n" + rest);
  }

  /// Command lines of living processes that name this folder, and run directories: what a run must not leave.
  std::vector<std::string> leftovers() const {
    std::vector<std::string> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator("/proc", error)) {
      std::ifstream stream(entry.path() / "cmdline");
      std::string words((std::istreambuf_iterator<char>(stream)), {});
      std::replace(words.begin(), words.end(), '\0', ' ');
      if (words.find(path_.string()) != std::string::npos) {
        found.push_back(words);
      }
    }
    for (const auto& entry : fs::directory_iterator(path_ / "ensonify", error)) {
      if (entry.path().filename() != "lock") {
        found.push_back(entry.path().string());
      }
    }
    return found;
  }

 private:
  fs::path path_;
};

/// A program under test.
class Program {
 public:
  Program(const Workplace& place, std::vector<std::string> words, const std::string& log = "log.txt",
          const std::string& error_log = "")
      : log_(place.file(log)),
        error_log_(error_log.empty() ? "" : place.file(error_log)),
        child_(command(std::move(words))) {}

  /// Waits for its end; the exit code, or minus the signal.
  int wait() {
    int status = 0;
    ::waitpid(child_.pid(), &status, 0);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  }
  std::string stated() const { return contents(log_); }

 private:
  Command command(std::vector<std::string> words) const {
    Command command;
    words[0] = std::string(std::getenv("ENSONIFY_BUILD")) + "/bin/" + words[0];
    command.argv = std::move(words);
    command.log_file = log_;
    command.error_file = error_log_;
    return command;
  }
  std::string log_, error_log_;
  Child child_;
};

struct Result {
  int code = 0;
  std::string stated;
};

Result run(const Workplace& place, std::vector<std::string> options = {}) {
  std::vector<std::string> words{"ensonify-run", place.file("x.yaml"), "--out", place.file("out")};
  words.insert(words.end(), options.begin(), options.end());
  Program program(place, std::move(words));
  const int code = program.wait();
  return {code, program.stated()};
}

/// Waits until `condition` holds; the test's time limit bounds it.
template <class Condition>
void until(Condition condition) {
  while (!condition()) {
    std::this_thread::yield();
  }
}

}  // namespace

TEST_CASE("a run to its hard end is 0, leaves its results and nothing else") {
  const Workplace place;
  place.two_stubs("duration_s: 3\n");
  const Result result = run(place, {"--junit", place.file("junit.xml")});
  CHECK(result.code == 0);
  CHECK(result.stated.find("3.0 s of sim time") != std::string::npos);
  const auto report = nlohmann::json::parse(contents(place.file("out/run.json")));
  CHECK(report["exit_code"] == 0);
  CHECK(report["processes"].size() == 3);
  CHECK(report["processes"][1]["name"] == "a");
  CHECK(report["processes"][1]["state"] == "DONE");
  CHECK(report["processes"][1]["max_rss_kib"] > 1000);
  CHECK(contents(place.file("junit.xml")).find("tests=\"3\" failures=\"0\"") != std::string::npos);
  CHECK(fs::exists(place.file("out/log/a.log")));
  CHECK(place.leftovers().empty());
}

TEST_CASE("a failing foreign program ends the run with 3, one that refuses arguments with 2") {
  const Workplace place;
  const auto with_foreign = [&](const std::string& script) {
    place.write("x.yaml", "ensonify: launch/1\nprocesses:\n  agent: {run: [sh, -c, '" + script + "']}\n" +
                              "clock: {rate: 1}\nduration_s: 60\n");
    return run(place);
  };
  const Result failed = with_foreign("echo it broke; exit 1");
  CHECK(failed.code == 3);
  CHECK(failed.stated.find("ensonify run: agent died (exit code 1): it broke") != std::string::npos);
  const Result refused = with_foreign("echo wrong words; exit 2");
  CHECK(refused.code == 2);
  CHECK(refused.stated.find("wrong words\nensonify run: agent refused") != std::string::npos);
  const Result left = with_foreign("exit 0");
  CHECK(left.code == 3);
  CHECK(left.stated.find("ensonify run: agent left before the end of the run") != std::string::npos);
  CHECK(place.leftovers().empty());
}

TEST_CASE("an observer that dies does not end the run") {
  const Workplace place;
  place.two_stubs("duration_s: 1\n");
  std::string text = contents(place.file("x.yaml"));
  const std::string processes = "processes:\n";
  text.insert(text.find(processes) + processes.size(), "  viewer: {run: [sh, -c, exit 9], observer: true}\n");
  place.write("x.yaml", text);
  CHECK(run(place).code == 0);
}

TEST_CASE("an observer that may come back is started again") {
  const Workplace place;
  place.write("x.yaml",
              "ensonify: launch/1\nprocesses:\n  a: {run: stub, config: {rate_hz: 10}}\n"
              "  viewer: {run: [sh, -c, 'echo x >> $(out)/starts; exit 9'], observer: true, respawn: true}\n"
              "clock: {rate: 1}\nduration_s: 1.5\n");
  CHECK(run(place).code == 0);
  CHECK(contents(place.file("out/starts")) == "x\nx");
}

TEST_CASE("an external process is awaited and may be started by anybody") {
  const Workplace place;
  place.two_stubs("duration_s: 1\n");
  std::string text = contents(place.file("x.yaml"));
  text.insert(text.find("  b: {") + 6, "external: true, join_s: 20, ");
  place.write("x.yaml", text);
  Program launcher(place, {"ensonify-run", place.file("x.yaml"), "--out", place.file("out")});
  std::string run_dir;
  until([&] {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(place.file("ensonify"), error)) {
      if (fs::exists(entry.path() / "clock.endpoint")) {
        run_dir = entry.path().string();
      }
    }
    return !run_dir.empty();
  });
  Program b(place,
            {"ensonify-stub", "--launch", place.file("x.yaml"), "--out", place.file("out"), "--name", "b", "--run-dir",
             run_dir, "--clock", contents(run_dir + "/clock.endpoint")},
            "b.txt");
  CHECK(b.wait() == 0);
  CHECK(launcher.wait() == 0);

  text.replace(text.find("join_s: 20"), 10, "join_s: 0.2");
  place.write("x.yaml", text + "\nclock: {connect_timeout_s: 0.2}\n");
  const Result alone = run(place);
  CHECK(alone.code == 4);
  CHECK(alone.stated.find("no hello from: b") != std::string::npos);
}

TEST_CASE("in one process a run has the same end, reports and steps") {
  const Workplace place;
  std::ofstream(place.file("x.yaml"))
      << "ensonify: launch/1\nscenario: scenarios/bay/scenario.yaml\nprocesses: {boat: {run: vehicle}}\nduration_s: 1\n"
         "expect: [{name: poses, count: {topic: boat/pose, min: 50}}]\nafter: [[touch, $(out)/after]]\n";
  const Result good = run(place, {"--in-process", "--junit", place.file("junit.xml")});
  CHECK(good.code == 0);
  CHECK(fs::exists(place.file("out/after")));
  CHECK(contents(place.file("junit.xml")).find("name=\"poses\"") != std::string::npos);
  const auto report = nlohmann::json::parse(contents(place.file("out/run.json")));
  CHECK(report.at("sim_s") == 1.0);
  CHECK(report.at("real_time_factor").get<double>() > 0.0);
  CHECK(good.stated.find("1.0 s of sim time in") != std::string::npos);
  CHECK(run(place, {"--in-process", "--set", "boat.bogus=1"}).code == 2);
  CHECK(nlohmann::json::parse(contents(place.file("out/run.json"))).at("sim_s") == 0.0);  // not of the run before
}

TEST_CASE("steps after the run see the output folder, and the first that fails decides") {
  const Workplace place;
  place.two_stubs(
      "duration_s: 0.5\nafter: [[sh, -c, 'echo done > $(out)/after'], [sh, -c, 'exit 5'], [touch, $(out)/never]]\n");
  const Result result = run(place);
  CHECK(result.code == 5);
  CHECK(contents(place.file("out/after")) == "done");
  CHECK_FALSE(fs::exists(place.file("out/never")));
  CHECK(result.stated.find("after: `sh -c exit 5` ended with exit code 5") != std::string::npos);
}

TEST_CASE("with --json standard output is the result alone, whatever later steps print") {
  const Workplace place;
  place.two_stubs("duration_s: 0.5\nafter: [[sh, -c, 'echo step taken']]\n");
  Program program(place, {"ensonify-run", place.file("x.yaml"), "--out", place.file("out"), "--json"}, "said",
                  "errors");
  CHECK(program.wait() == 0);
  CHECK(nlohmann::json::parse(program.stated()).at("exit_code") == 0);
  CHECK(contents(place.file("errors")).find("step taken") != std::string::npos);
}

TEST_CASE("the dispatcher finds the nearest verb") {
  const Workplace place;
  Program program(place, {"ensonify", "rnu"});
  CHECK(program.wait() == 2);
  CHECK(program.stated().find("ensonify: there is no rnu; did you mean run?") == 0);
  // Where only some programs are built, as for the demo.
  fs::create_directories(place.file("bin"));
  const fs::path built = fs::path(std::getenv("ENSONIFY_BUILD")) / "bin";
  fs::copy_file(built / "ensonify", place.file("bin/ensonify"));
  Program alone(place, {fs::relative(place.file("bin/ensonify"), built), "info"});
  CHECK(alone.wait() == 2);
  CHECK(alone.stated().find("ensonify: info is not built here") == 0);
  Program help(place, {"ensonify", "--help"});
  CHECK(help.wait() == 0);
  CHECK(help.stated().find("Usage: ensonify VERB") == 0);
}

TEST_CASE("check asks every program for its ports and checks the wiring") {
  const Workplace place;
  const auto check = [&] {
    Program program(place, {"ensonify-check", place.file("x.yaml")});
    const int code = program.wait();
    return std::to_string(code) + " " + program.stated();
  };
  place.two_stubs();
  CHECK(check() == "0 " + place.file("x.yaml") + ": 2 processes, valid");
  place.two_stubs("wiring: {b.x: a/y}\n");
  CHECK(check().find("2 " + place.file("x.yaml") + ":5:15: wiring.b.x: no process publishes a/y") == 0);
  place.two_stubs("", ", rate: 1");
  CHECK(check().find("processes.a.config.rate: is not a known key") != std::string::npos);
  place.write("x.yaml", "ensonify: launch/1\nprocesses: {a: {run: [sh, -c, 'exit 0']}}\n");
  CHECK(check().find("warning: a: its ports are not known before it runs") != std::string::npos);
  CHECK(place.leftovers().empty());
}

TEST_CASE("shipped launches are valid; coarse posts, uneven classes and a head's limits are reported") {
  const Workplace place;
  const std::string source = std::getenv("ENSONIFY_SOURCE");
  const auto check = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "ensonify-check");
    Program program(place, std::move(words));
    const int code = program.wait();
    return std::to_string(code) + " " + program.stated();
  };
  const std::string demo = source + "/launch/demo.yaml";
  CHECK(check({demo}) == "0 " + demo + ": 7 processes, valid");
  CHECK(check({demo, "--set", "seabed.post_spacing_m=1"})
            .find("warning: pager: posts are 1 m apart, but bow resolves 0.2") != std::string::npos);
  const std::string sand = "seabed.sediments={0: medium sand}";
  const std::string to_22_m =  // 57 m east of the middle of 480 m
      "seabed.layers.relief={spectral: {as_sediment: medium sand, outer_scale_m: 40}, mask: {depth_m: {to: 22}}}";
  CHECK(check({demo, "--set", sand}).find("warning") == std::string::npos);
  CHECK(check({demo, "--set", sand, "--set", to_22_m}).find("warning: layer relief holds at 0.6") != std::string::npos);

  const auto with_level = [&](const std::string& level_db, const std::string& highest_db) {
    place.write("mission.yaml", "ensonify: mission/1\nsteps:\n  - {set_sonar: bow, source_level_db: " + level_db +
                                    "}\n  - line: [[0, -40], [0, 40]]\n");
    return check({demo, "--set", "mission={file: " + place.file("mission.yaml") + "}", "--set",
                  "bow.source_level_db=" + highest_db});
  };
  const std::string at = "2 " + place.file("mission.yaml") + ":3:39: steps[0].source_level_db: ";
  CHECK(with_level("245", "250") == "0 " + demo + ": 7 processes, valid");
  CHECK(with_level("260", "250").find(at + "260 is outside [210, 250], the limits of bow") == 0);
  CHECK(with_level("245", "230").find(at + "245 is outside [190, 230], the limits of bow") == 0);

  const std::string survey = source + "/launch/survey.yaml";
  CHECK(check({survey}).find("2 " + survey + ":6:3: args.raster: must be given; use --arg raster=VALUE") == 0);
  const std::string raster = std::string(std::getenv("ENSONIFY_SHARED")) + "/data/terrain/massbay_5m.tif";
  if (!fs::exists(raster)) {
    WARN("skipped: no " << raster);
    return;
  }
  CHECK(check({survey, "--arg", "raster=" + raster}).find("processes, valid") != std::string::npos);
}

}  // namespace ensonify::launcher
