#include "launch/dataset/plan.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace ensonify;
using namespace ensonify::dataset;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

struct Scratch {
  Scratch() { fs::create_directories(path); }
  ~Scratch() { fs::remove_all(path); }
  std::string text(const std::string& name) const {
    std::ifstream stream(path / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  fs::path path = fs::temp_directory_path() / ("ensonify_plan_" + std::to_string(::getpid()));
};

Recipe recipe_of(const std::string& more) {
  return read_recipe(
      parse_config("ensonify: recipe/1\nlaunch: launch/demo.yaml\nhead: eye\nargs: { seconds: { integer: [3, 9] } }\n"
                   "objects: { can: { object: { sphere: { diameter_m: 0.2 } } } }\n"
                   "place: { east_m: { uniform: [-8, 8] }, north_m: 4 }\n" +
                       more,
                   "r.yaml"),
      "r.yaml");
}

std::vector<Scene> scenes_of(const Recipe& recipe, const Extent& extent) {
  std::vector<Scene> scenes;
  for (std::uint64_t i = 0; i < extent.scenes; ++i) scenes.push_back(draw_scene(recipe, extent.first_scene + i));
  return scenes;
}

}  // namespace

TEST_CASE("pictures need so many scenes, and one picture its own") {
  const Recipe recipe = recipe_of("samples: 4\n");
  CHECK(Extent::of(recipe, 8).scenes == 2);
  CHECK(Extent::of(recipe, 9).scenes == 3);
  CHECK(Extent::around(recipe, 9).first_scene == 2);
}

TEST_CASE("a scene's job is the same in every plan that has it, and another for another recipe") {
  const Recipe recipe = recipe_of("samples: 4\n"), other = recipe_of("samples: 4\npicture: { least_pixels: 3 }\n");
  const auto all = jobs_of(recipe, scenes_of(recipe, Extent::of(recipe, 12)), "base");
  const auto one = jobs_of(recipe, scenes_of(recipe, Extent::around(recipe, 9)), "base");
  CHECK(one[0].id == all[2].id);
  CHECK(one[0].options.sets == all[2].options.sets);
  CHECK(one[0].options.args == all[2].options.args);
  CHECK(all[0].id != all[1].id);
  CHECK(jobs_of(recipe, scenes_of(recipe, Extent::of(recipe, 1)), "other base")[0].id != all[0].id);
  CHECK(jobs_of(other, scenes_of(other, Extent::of(other, 1)), "base")[0].id != all[0].id);
}

TEST_CASE("a plan has a line for each scene and each of its pairs") {
  const Scratch scratch;
  const Recipe recipe = recipe_of("pairs: { bare: { without: objects } }\n");
  std::vector<Scene> scenes = scenes_of(recipe, Extent::of(recipe, 2));
  scenes.push_back(pairs_of(recipe, scenes[1])[0]);
  const auto jobs = jobs_of(recipe, scenes, "base");
  CHECK(jobs[2].label == "scene 1 bare");
  CHECK(jobs[2].id != jobs[1].id);
  write_plan(recipe, lines_of(scenes, jobs, false), scratch.path);
  CHECK_THAT(scratch.text("scenes.jsonl"), Contains("\n{\"scene\":1,\"pair\":\"\","));
  CHECK_THAT(scratch.text("scenes.jsonl"), Contains("\n{\"scene\":1,\"pair\":\"bare\","));
  CHECK_THAT(scratch.text("scenes.jsonl"), !Contains("\"ground\":0"));
  CHECK_THAT(lines_of(scenes, jobs, true)[0], Contains("\"ground\":0"));
}
