#include "launch/dataset/plan.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "components/config/config_text.h"
#include "launch/report.h"

namespace ensonify::dataset {
namespace {

using Json = nlohmann::ordered_json;

std::string absolute(const std::string& path) { return std::filesystem::absolute(path).lexically_normal().string(); }

/// Goes on from the recipe's launch: pictures are made of each run as soon as it has ended.
std::string launch_of(const Recipe& recipe, const std::string& folder, bool keep) {
  Json args = {{"scene", nullptr}}, given = Json::object();
  for (const auto& entry : recipe.args.tree.entries) {
    args[entry.key] = nullptr;
    given[entry.key] = "$(" + entry.key + ")";
  }
  Json pictures = {"python3", "-m", "ensonify.dataset", "scene", absolute(folder), "$(scene)", "$(out)"};
  if (keep) pictures.push_back("--keep");
  const Json include = {{"file", absolute(recipe.launch)}, {"args", given}};
  return "ensonify: launch/1\nargs: " + args.dump() + "\ninclude: " + Json::array({include}).dump() +
         "\nafter: " + Json::array({pictures}).dump() + "\n";
}

Json json_of(const Recipe& recipe) {
  Json names = Json::array();
  for (const std::string& name : recipe.classes()) names.push_back(name);
  const PictureKeys& picture = recipe.picture;
  Json json = {{"head", recipe.head},
               {"classes", names},
               {"samples", recipe.samples},
               {"formats", recipe.formats},
               {"view", picture.view},
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
  return {{"scene", scene.number},
          {"id", id},
          {"split", scene.split},
          {"seed", scene.seed},
          {"ground", same_ground ? 0 : scene.seed},
          {"samples", samples},
          {"things", things},
          {"drawn", drawn}};
}

}  // namespace

Extent Extent::of(const Recipe& recipe, std::uint64_t pictures) {
  const auto each = static_cast<std::uint64_t>(recipe.samples);
  return {pictures, 0, (pictures + each - 1) / each};
}

Extent Extent::around(const Recipe& recipe, std::uint64_t number) {
  return {1, number / static_cast<std::uint64_t>(recipe.samples), 1};
}

std::vector<batch::Job> jobs_of(const Recipe& recipe, const std::vector<Scene>& scenes, const std::string& base,
                                const std::string& folder) {
  std::vector<batch::Job> jobs;
  for (const Scene& scene : scenes) {
    batch::Job job;
    job.label = "scene " + std::to_string(scene.number);
    job.options.file = folder + "/launch.yaml";
    job.options.args = scene.args;
    job.options.args.push_back("scene=" + std::to_string(scene.number));
    job.options.sets = scene.sets;
    job.id = batch::id_of({base, recipe.text, std::to_string(scene.number)});
    jobs.push_back(std::move(job));
  }
  return jobs;
}

void write_plan(const Recipe& recipe, const std::vector<Scene>& scenes, const std::vector<batch::Job>& jobs,
                const std::string& folder, const PlanOptions& options) {
  launcher::write_text(folder + "/launch.yaml", launch_of(recipe, folder, options.keep));
  launcher::write_text(folder + "/recipe.json", json_of(recipe).dump(1) + "\n");
  std::string lines;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    lines += json_of(scenes[i], jobs[i].id, options.same_ground).dump() + "\n";
  launcher::write_text(folder + "/scenes.jsonl", lines);
}

}  // namespace ensonify::dataset
