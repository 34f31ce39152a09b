#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "components/errors/exit_error.h"
#include "launch/batch/find.h"
#include "launch/batch/results.h"

using namespace ensonify;
using namespace ensonify::batch;

namespace {

namespace fs = std::filesystem;

/// A folder that goes with the test.
struct Scratch {
  Scratch() { fs::create_directories(path); }
  ~Scratch() { fs::remove_all(path); }
  std::string file(const std::string& name, const std::string& text) const {
    fs::create_directories((path / name).parent_path());
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
  std::string text(const std::string& name) const {
    std::ifstream stream(path / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  fs::path path = fs::temp_directory_path() / ("ensonify_batch_" + std::to_string(::getpid()));
};

const std::string kScenario =
    "  ensonify: scenario/1\n  site: {latitude_deg: 1, longitude_deg: 2}\n  seabed: {kind: layers}\n"
    "  mission: {runlines: [{from_m: [0, 0], to_m: [0, 9]}]}\n";
const std::string kExpect = "expect: [{count: {topic: auv/pose, min: 1}}]\n";

std::string launch_text(const std::string& more = kExpect, const std::string& script = "x.py") {
  return "ensonify: launch/1\nscenario:\n" + kScenario +
         "processes:\n  auv: {run: vehicle}\n  agent: {run: [python3, " + script + "]}\n" + more;
}

std::string id(const std::string& file, const std::vector<std::string>& sets = {}, const std::string& out = "out") {
  LaunchOptions options;
  options.file = file;
  options.sets = sets;
  options.out = out;
  return id_of(read_launch(options), "/nowhere");
}

std::vector<Job> three_jobs() {
  std::vector<Job> jobs;
  for (const char* id : {"aa", "bb", "cc"}) {
    jobs.push_back({.label = std::string("launch ") + id, .id = id});
  }
  return jobs;
}

}  // namespace

TEST_CASE("a job's id follows from what decides its results, and nothing else") {
  const Scratch scratch;
  scratch.file("x.py", "one");
  const std::string file = scratch.file("a.yaml", launch_text());
  const std::string first = id(file);
  CHECK(first.size() == 16);
  CHECK(id(file, {}, "elsewhere") == first);
  CHECK(id(file, {"clock.rate=3"}) == first);
  CHECK(id(scratch.file("b.yaml", launch_text())) == first);
  const std::string to_out = kExpect + "after: [[cp, x, $(out)/y]]\n",
                    exits = "expect: [{exit: {process: agent, code: 3}}]\n";
  const std::string with_out = scratch.file("c.yaml", launch_text(to_out));
  CHECK(id(with_out, {}, "elsewhere") == id(with_out));
  CHECK(id(with_out) != first);
  CHECK(id(scratch.file("d.yaml", launch_text(exits))) != first);
  CHECK(id(file, {"seabed.post_spacing_m=1"}) != first);
  CHECK(id(file, {"auv.pose_rate_hz=20"}) != first);
  scratch.file("x.py", "two");
  CHECK(id(file) != first);
}

TEST_CASE("launch files with expectations are found in folders, each once") {
  const Scratch scratch;
  scratch.file("t/one.yaml", launch_text());
  scratch.file("t/deep/two.yml", launch_text());
  scratch.file("t/none.yaml", launch_text(""));
  scratch.file("t/part.yaml", "ensonify: launch/1\nset: {bow.beams: 3}\n");
  scratch.file("t/other.yaml", "hello: 1\n");
  scratch.file("t/.hidden/three.yaml", launch_text());
  scratch.file("t/arg.yaml", "ensonify: launch/1\nargs: {raster: }\nprocesses: {auv: {run: vehicle}}\n" + kExpect);
  scratch.file("t/waits.yaml",
               "ensonify: launch/1\nprocesses: {auv: {run: vehicle}, agent: {external: true}}\n" + kExpect);
  scratch.file("t/wrong.yaml", "ensonify: launch/1\nprocesses: {auv: {run: vehicle}}\nspeed: 1\n" + kExpect);
  const std::string folder = (scratch.path / "t").string();
  const auto found = find_launches({folder, folder + "/one.yaml"}, {}, "/nowhere");
  REQUIRE(found.size() == 5);
  CHECK(found[0].file == folder + "/arg.yaml");
  CHECK(found[0].skipped == "needs --arg raster=VALUE");
  CHECK(found[1].file == folder + "/deep/two.yml");
  CHECK(found[1].skipped.empty());
  CHECK(found[2].file == folder + "/one.yaml");
  CHECK(found[3].skipped == "waits for agent, which somebody else starts");
  CHECK_THAT(found[4].fault, Catch::StartsWith(folder + "/wrong.yaml:3:1: speed: is not a known key"));

  FindOptions options;
  options.args = {"raster=/dev/null"};
  options.text = "arg";
  const auto given = find_launches({folder}, options, "/nowhere");
  REQUIRE(given.size() == 1);
  CHECK(given[0].skipped.empty());
  options.args = {"rasta=1"};
  CHECK_THROWS_WITH(find_launches({folder}, options, "/nowhere"),
                    "--arg rasta=1: no launch file has an argument rasta");
  options = {.text = "nothing"};
  CHECK_THROWS_WITH(find_launches({folder}, options, "/nowhere"),
                    "no launch file with `expect:` whose path holds \"nothing\" in " + folder);
  CHECK_THROWS_WITH(
      find_launches({folder + "/none.yaml"}, {}, "/nowhere"),
      folder + "/none.yaml: has no `expect:`, so there is nothing to test; allowed: a launch file that has");
  CHECK_THROWS_WITH(find_launches({folder + "/no.yaml"}, {}, "/nowhere"),
                    folder + "/no.yaml: does not exist; allowed: launch files, and folders that hold some");
}

TEST_CASE("a batch goes on where it was, and its table is in the plan's order") {
  const Scratch scratch;
  const std::string path = (scratch.path / "out").string();
  const std::vector<Job> plan = three_jobs();
  const std::string said =
      R"({"sim_s": 2.5, "culprit": null, "message": "a, b", "expect": [{"name": "x", "ok": false, "t_s": 1, "message": "no"}]})";
  {
    const Folder folder(path, plan);
    folder.done(plan[2], 1, said, 0.5);
  }
  const Folder folder(path, plan);
  CHECK_FALSE(folder.result_of(plan[0]));
  const auto result = folder.result_of(plan[2]);
  REQUIRE(result);
  CHECK(result->exit_code == 1);
  CHECK(result->failed() == 1);
  CHECK(result->expectations.at(0).message == "no");
  folder.done(plan[0], 0, R"({"sim_s": 1, "expect": []})", 0.1);
  folder.write_table(plan);
  CHECK(scratch.text("out/results.csv") ==
        "id,label,exit_code,expectations,failed,sim_s,message\naa,launch aa,0,0,0,1.000,\n"
        "cc,launch cc,1,1,1,2.500,\"a, b\"\n");
  // What was not written whole is not done.
  fs::create_directories(folder.run_of(plan[1]));
  std::ofstream(folder.run_of(plan[1]) + "/result.json.part") << "{";
  CHECK_FALSE(folder.result_of(plan[1]));
}

TEST_CASE("a folder of another plan is refused, and forgotten only if it is a batch's") {
  const Scratch scratch;
  const std::string path = (scratch.path / "out").string();
  std::vector<Job> plan = three_jobs();
  const Folder folder(path, plan);
  folder.done(plan[0], 0, "{}", 0.1);
  plan.pop_back();
  CHECK_THROWS_AS(Folder(path, plan), UserError);
  scratch.file("out/mine.txt", "kept");
  Folder::forget(path);
  CHECK_FALSE(Folder(path, plan).result_of(plan[0]));
  CHECK(scratch.text("out/mine.txt") == "kept");
  scratch.file("other/runs/precious", "kept");
  Folder::forget((scratch.path / "other").string());
  CHECK(scratch.text("other/runs/precious") == "kept");
}

TEST_CASE("shards hold every job once") {
  const std::vector<Job> plan = three_jobs();
  const auto first = shard_of(plan, 1, 2), second = shard_of(plan, 2, 2);
  REQUIRE(first.size() == 2);
  REQUIRE(second.size() == 1);
  CHECK(first[1].id == "cc");
  CHECK(second[0].id == "bb");
}
