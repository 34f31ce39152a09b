#include "launch/dataset/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/config/config_text.h"
#include "components/errors/nearest_name.h"

namespace ensonify::dataset {
namespace {

const std::vector<std::string> kFormats = {"masks", "coco", "yolo", "voc", "webdataset"};

bool is_name(const std::string& name) {
  return !name.empty() && name.size() <= 32 &&
         std::ranges::all_of(name, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; });
}

void check_map(const ConfigReader& from, const char* key, const Drawn& drawn, const std::string& what) {
  if (drawn.given() && !drawn.tree.is_map()) from.problem(key, "is not a map from " + what);
}

void check_draw(const ConfigReader& from, const Drawn& draw) {
  check_map(from, "draw", draw, "KEY, as of --set, to values");
  if (draw.tree.find("seed") != nullptr) from.problem("draw.seed", "is drawn for each scene by itself");
}

void check_name(const ConfigReader& from, const std::string& name) {
  if (!is_name(name)) from.problem("", "is not a name; allowed: up to 32 of a-z, 0-9 and _");
}

}  // namespace

void Kind::check(const ConfigReader& from) const {
  check_name(from, name);
  if (!object.given()) return;
  if (!object.tree.is_map()) return from.problem("object", "is not a map of an object's keys");
  for (const char* own : {"class", "strewn", "position_m"}) {
    if (object.tree.find(own) != nullptr)
      from.problem(std::string("object.") + own, "is given by the recipe: see class, count, place and up_m");
  }
  if (const ConfigNode* on = object.tree.find("on_seabed"); on != nullptr && on->find("at_m") != nullptr)
    from.problem("object.on_seabed.at_m", "is given by the recipe: see place");
}

void Sector::check(const ConfigReader& from) const {
  if (range_m[0] > range_m[1])
    from.problem("range_m", fmt::format("{} is over {}; allowed: [least, most]", range_m[0], range_m[1]));
}

void PairKeys::check(const ConfigReader& from) const {
  check_name(from, name);
  check_draw(from, draw);
  if (without == Without::kNothing && draw.tree.entries.empty())
    from.problem("", "changes nothing; allowed: `without`, `draw` or both");
}

void Splits::check(const ConfigReader& from) const {
  if (const double sum = train + val + test; std::abs(sum - 1.0) > 1e-9)
    from.problem("", fmt::format("train, val and test are {:g} together; allowed: 1", sum));
}

void Recipe::check(const ConfigReader& from) const {
  check_map(from, "args", args, "arguments to values");
  check_draw(from, draw);
  if (objects.empty() && empty_share < 1.0)
    from.problem("objects", "is empty; allowed: one or more, or empty_share: 1");
  for (const std::string& name : classes()) {
    double sum = 0.0;
    for (const Kind& kind : objects) sum += kind.class_name == name ? kind.weight : 0.0;
    if (!(sum > 0.0)) from.problem("objects", "class " + name + " has no objects: all weights are 0");
  }
  for (const Kind& kind : clutter) {
    if (std::ranges::any_of(objects, [&](const Kind& other) { return other.name == kind.name; }))
      from.problem("clutter." + kind.name, "is a name of objects too");
  }
  if (picture.chip && picture.mask == "response")
    from.problem("picture.mask", "response is of whole pings; allowed of chips: geometry");
  if (formats.empty()) from.problem("formats", "is empty; allowed: " + fmt::format("{}", fmt::join(kFormats, ", ")));
  for (const std::string& one : formats) {
    if (std::ranges::find(kFormats, one) != kFormats.end()) continue;
    const std::string near = nearest_name(one, kFormats);
    from.problem("formats", fmt::format("{} is not a format; {}", one,
                                        near.empty() ? fmt::format("allowed: {}", fmt::join(kFormats, ", "))
                                                     : "did you mean " + near + "?"));
  }
}

std::vector<std::string> Recipe::classes() const {
  std::vector<std::string> names;
  for (const Kind& kind : objects) {
    if (std::ranges::find(names, kind.class_name) == names.end()) names.push_back(kind.class_name);
  }
  return names;
}

Recipe read_recipe(ConfigDocument document, const std::string& file) {
  Recipe recipe;
  recipe.file = file;
  recipe.text = to_canonical_yaml(document.root);
  const ConfigNode* place = document.root.find("place");
  recipe.of_place = place != nullptr ? place->place : document.root.place;
  ConfigReader from(std::move(document));
  read_parameters(from, recipe);
  from.finish();
  return recipe;
}

Recipe read_recipe(const std::string& file) { return read_recipe(parse_config_file(file), file); }

}  // namespace ensonify::dataset
