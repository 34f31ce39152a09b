#include "launch/batch/merge.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "components/errors/exit_error.h"
#include "launch/batch/results.h"

using namespace ensonify;
using namespace ensonify::batch;

namespace {

namespace fs = std::filesystem;
using Catch::Contains;

std::vector<Job> five_jobs() {
  std::vector<Job> jobs;
  for (const char* id : {"aa", "bb", "cc", "dd", "ee"}) {
    Job job{.label = std::string("launch/") + id + ".yaml", .id = id, .programs = "0123"};
    job.options.file = job.label;
    job.options.sets = {"seed=7"};
    jobs.push_back(job);
  }
  return jobs;
}

void run(const Folder& folder, const Job& job) {
  folder.done(job, job.id == "bb" ? 1 : 0, R"({"sim_s":2.5,"expect":[{"name":"one","ok":true}]})", 0.3);
  std::ofstream(folder.run_of(job) + "/clock.log") << job.id;
}

std::string text(const fs::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A batch run whole, and in two parts.
struct Parts {
  Parts() {
    fs::remove_all(path);
    const Folder whole(of("whole"), plan), one(of("one"), plan), two(of("two"), plan);
    for (const Job& job : plan) run(whole, job);
    for (const Job& job : shard_of(plan, 1, 2)) run(one, job);
    for (const Job& job : shard_of(plan, 2, 2)) run(two, job);
    whole.write_table(plan);
  }
  ~Parts() { fs::remove_all(path); }
  std::string of(const std::string& name) const { return (path / name).string(); }
  /// Another text in a part's plan.
  void change(const std::string& part, const std::string& from, const std::string& to) const {
    const std::string plan_text = std::regex_replace(text(of(part) + "/plan.json"), std::regex(from), to);
    REQUIRE(plan_text != text(of(part) + "/plan.json"));
    std::ofstream(of(part) + "/plan.json") << plan_text;
  }
  Shards read() const { return read_shards({of("one"), of("two")}); }

  fs::path path = fs::temp_directory_path() / ("ensonify_merge_" + std::to_string(::getpid()));
  std::vector<Job> plan = five_jobs();
};

}  // namespace

TEST_CASE("shards together are what one batch is") {
  const Parts parts;
  put_together(parts.read(), parts.of("joined"));
  CHECK(text(parts.of("joined") + "/results.csv") == text(parts.of("whole") + "/results.csv"));
  CHECK(text(parts.of("joined") + "/plan.json") == text(parts.of("whole") + "/plan.json"));
  CHECK(text(parts.of("joined") + "/runs/dd/clock.log") == "dd");
  CHECK(fs::exists(parts.of("two") + "/runs/dd/result.json"));
}

TEST_CASE("the order in which shards are named changes nothing") {
  const Parts parts;
  put_together(read_shards({parts.of("two"), parts.of("one")}), parts.of("joined"));
  CHECK(text(parts.of("joined") + "/results.csv") == text(parts.of("whole") + "/results.csv"));
}

TEST_CASE("launches that no shard or more than one has are named") {
  const Parts parts;
  CHECK_THROWS_WITH(read_shards({parts.of("one")}), Contains("2 of 5 launches are done in none of the folders") &&
                                                        Contains("launch/bb.yaml") && Contains("launch/dd.yaml"));
  CHECK_THROWS_WITH(read_shards({parts.of("one"), parts.of("whole")}),
                    Contains("3 of 5 launches are done more than once") &&
                        Contains("launch/cc.yaml: " + parts.of("one") + " and " + parts.of("whole")));
  CHECK_THROWS_WITH(read_shards({parts.of("one"), parts.of("one") + "/."}), Contains("is named twice"));
}

TEST_CASE("shards of another version, processor, build or plan are named") {
  const Parts parts;
  SECTION("version") {
    parts.change("two", "\"version\": \"[^\"]*\"", "\"version\": \"0.0.1\"");
    CHECK_THROWS_WITH(parts.read(), Contains(parts.of("two") + ": is of version 0.0.1, " + parts.of("one") + " of "));
  }
  SECTION("processor") {
    parts.change("two", "\"avx[0-9]*\"", "\"sse\"");
    CHECK_THROWS_WITH(parts.read(), Contains("was run with sse, " + parts.of("one") + " with avx"));
  }
  SECTION("build") {
    parts.change("two", "0123", "4567");
    CHECK_THROWS_WITH(parts.read(), Contains("launch/aa.yaml was run by other programs: another build"));
  }
  SECTION("launch") {
    parts.change("two", "\"id\": \"dd\"", "\"id\": \"d2\"");
    CHECK_THROWS_WITH(parts.read(), Contains("launch/dd.yaml was another launch, or a file that it names was another"));
  }
  SECTION("settings") {
    parts.change("two", "seed=7", "seed=8");
    CHECK_THROWS_WITH(parts.read(), Contains("launch/aa.yaml is there in the place of launch/aa.yaml, or has other"));
  }
  SECTION("fewer") {
    const Folder fewer(parts.of("fewer"), {parts.plan[0]});
    CHECK_THROWS_WITH(read_shards({parts.of("one"), parts.of("fewer")}), Contains("launch/bb.yaml is not in it"));
    CHECK_THROWS_WITH(read_shards({parts.of("fewer"), parts.of("one")}), Contains("launch/bb.yaml is in it"));
  }
}

TEST_CASE("a folder that is no batch's is named") {
  const Parts parts;
  CHECK_THROWS_WITH(read_shards({parts.of("nothing")}), Contains("is no folder of `ensonify test`"));
  parts.change("two", "\"sets\"", "\"rows\"");
  CHECK_THROWS_WITH(parts.read(), Contains("plan.json: is not what `ensonify test` writes"));
}
