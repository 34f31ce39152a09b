#include "launch/dataset/plan.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "components/config/config_text.h"
#include "launch/report.h"

namespace ensonify::dataset {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Recipe& recipe) {
  Json names = Json::array();
  for (const std::string& name : recipe.classes()) names.push_back(name);
  const PictureKeys& picture = recipe.picture;
  Json json = {{"head", recipe.head},
               {"classes", names},
               {"samples", recipe.samples},
               {"formats", recipe.formats},
               {"view", picture.view},
               {"mask", picture.mask},
               {"box", picture.box},
               {"first", picture.first_ping},
               {"every", picture.every},
               {"least_pixels", picture.least_pixels},
               {"white_db", picture.white_db},
               {"range_db", picture.range_db},
               {"chip", nullptr}};
  if (picture.chip)
    json["chip"] = {{"width", picture.chip->width}, {"height", picture.chip->height}, {"jitter", picture.chip->jitter}};
  json["seed"] = recipe.seed;
  json["text"] = recipe.text;
  return json;
}

Json json_of(const Scene& scene, const std::string& id, bool same_ground) {
  Json samples = Json::array(), things = Json::array(), drawn = Json::object();
  for (const Sample& sample : scene.samples)
    samples.push_back(
        {{"number", sample.number}, {"kind", sample.kind}, {"place", sample.place}, {"shift", sample.shift}});
  for (const Thing& thing : scene.things)
    things.push_back({{"name", thing.name},
                      {"kind", thing.kind},
                      {"class", thing.class_name},
                      {"labelled", thing.labelled},
                      {"place", thing.place},
                      {"object", Json::parse(to_json(thing.object))}});
  for (const auto& [key, value] : scene.drawn) drawn[key] = Json::parse(to_json(value));
  return {{"scene", scene.number}, {"pair", scene.pair}, {"id", id},
          {"split", scene.split},  {"seed", scene.seed}, {"ground", same_ground ? 0 : scene.seed},
          {"samples", samples},    {"things", things},   {"drawn", drawn}};
}

}  // namespace

Extent Extent::of(const Recipe& recipe, std::uint64_t pictures) {
  const auto each = static_cast<std::uint64_t>(recipe.samples);
  return {pictures, 0, (pictures + each - 1) / each};
}

Extent Extent::around(const Recipe& recipe, std::uint64_t number) {
  return {1, number / static_cast<std::uint64_t>(recipe.samples), 1};
}

std::vector<batch::Job> jobs_of(const Recipe& recipe, const std::vector<Scene>& scenes, const std::string& base) {
  std::vector<batch::Job> jobs;
  for (const Scene& scene : scenes) {
    batch::Job job;
    const std::string number = std::to_string(scene.number);
    job.label = "scene " + number + (scene.pair.empty() ? "" : " " + scene.pair);
    job.options.file = std::filesystem::absolute(recipe.launch).lexically_normal().string();
    job.options.args = scene.args;
    job.options.sets = scene.sets;
    // Shards of other machines give the same bytes, unless the recipe wants otherwise.
    job.options.sets.insert(job.options.sets.begin(), "isa=avx2");
    job.id = batch::id_of({base, recipe.text, number, scene.pair});
    jobs.push_back(std::move(job));
  }
  return jobs;
}

std::vector<std::string> lines_of(const std::vector<Scene>& scenes, const std::vector<batch::Job>& jobs,
                                  bool same_ground) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < scenes.size(); ++i) lines.push_back(json_of(scenes[i], jobs[i].id, same_ground).dump());
  return lines;
}

void write_plan(const Recipe& recipe, const std::vector<std::string>& lines, const std::string& folder) {
  launcher::write_text(folder + "/recipe.json", json_of(recipe).dump(1) + "\n");
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  launcher::write_text(folder + "/scenes.jsonl", all);
}

}  // namespace ensonify::dataset
