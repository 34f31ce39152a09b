#include "launch/dataset/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "components/config/config_text.h"
#include "components/config/data_paths.h"
#include "components/config/scalar_text.h"
#include "kernels/base/random/stream.h"

namespace ensonify::dataset {
namespace {

constexpr double kMostOfAKind = 1000;

ConfigNode list_of(std::initializer_list<double> numbers) {
  ConfigNode list;
  list.kind = ConfigNode::Kind::kList;
  for (const double number : numbers) list.items.push_back(ConfigNode::text(shortest_number(number)));
  return list;
}

/// Paths of files, such as a mesh's, start beside the recipe.
void find_files(ConfigNode& node, const std::string& folder) {
  for (auto& entry : node.entries) {
    if (entry.key != "file" || !entry.value.is_scalar()) {
      find_files(entry.value, folder);
    } else if (const std::string found = find_data(entry.value.scalar, {folder}); !found.empty()) {
      entry.value.scalar = std::filesystem::absolute(found).lexically_normal().string();
    }
  }
}

bool in_sector(const Sector& sector, const std::array<double, 2>& place) {
  const double east = place[0] - sector.from_m[0], north = place[1] - sector.from_m[1];
  const double distance = std::hypot(east, north);
  const double off = std::remainder(std::atan2(east, north) - sector.heading_rad, 2.0 * std::numbers::pi);
  return distance >= sector.range_m[0] && distance <= sector.range_m[1] && std::abs(off) <= sector.half_angle_rad;
}

/// Puts the things of a scene into place, one after another.
class Placer {
 public:
  Placer(const Recipe& recipe, Scene& scene) : recipe_(recipe), scene_(scene) {}

  /// The objects and the clutter of a picture; its middle.
  std::array<double, 2> group(std::size_t number, const std::string& kind) {
    std::optional<std::array<double, 2>> middle;
    const auto add_all = [&](const Kind& of, const char* section, bool labelled) {
      const std::string path = fmt::format("{}.{}.count", section, of.name);
      const auto count = static_cast<int>(draw_number(of.count, path, at(number), 0.0, kMostOfAKind));
      for (int i = 0; i < count; ++i) {
        const auto place = free_place(number);
        if (!middle) middle = place;
        add(of, section, labelled, fmt::format("{}_{}_{}", of.name, number, i + 1), place);
      }
    };
    for (const Kind& of : recipe_.objects) {
      if (of.name == kind) add_all(of, "objects", true);
    }
    for (const Kind& of : recipe_.clutter) add_all(of, "clutter", false);
    return middle ? *middle : free_place(number);
  }

 private:
  Counter at(std::uint64_t item, std::uint64_t attempt = 0) const {
    return {recipe_.seed, scene_.number, item, attempt, scene_.split};
  }

  std::array<double, 2> free_place(std::size_t group) {
    std::map<std::string, int> failed;
    const auto step = static_cast<double>(group);
    const std::uint64_t item = places_.size();
    for (int attempt = 0; attempt < recipe_.place.tries; ++attempt) {
      const Counter now = at(item, static_cast<std::uint64_t>(attempt));
      const auto& keys = recipe_.place;
      const std::array<double, 2> place{
          draw_number(keys.east_m, "place.east_m", now, -kFarAway_m, kFarAway_m) + step * keys.step_m[0],
          draw_number(keys.north_m, "place.north_m", now, -kFarAway_m, kFarAway_m) + step * keys.step_m[1]};
      const std::string constraint = broken(place);
      if (constraint.empty()) {
        places_.push_back(place);
        return place;
      }
      ++failed[constraint];
    }
    const auto worst = std::ranges::max_element(failed, {}, [](const auto& one) { return one.second; });
    throw ConfigError({{recipe_.of_place, "place",
                        fmt::format("scene {} has no room for its {}. thing: of {} tries {} fail by {}", scene_.number,
                                    item + 1, recipe_.place.tries, worst->second, worst->first)}});
  }

  /// The constraint that a place does not satisfy; "": there is none.
  std::string broken(const std::array<double, 2>& place) const {
    if (recipe_.place.seen_from && !in_sector(*recipe_.place.seen_from, place)) return "seen_from";
    const bool near = std::ranges::any_of(places_, [&](const auto& other) {
      return std::hypot(place[0] - other[0], place[1] - other[1]) < recipe_.place.apart_m;
    });
    return near ? "apart_m" : "";
  }

  void add(const Kind& of, const char* section, bool labelled, const std::string& name,
           const std::array<double, 2>& place) {
    const Counter now = at(places_.size() - 1);
    const std::string path = fmt::format("{}.{}", section, of.name);
    Values drawn;
    ConfigNode object = draw(of.object.tree, path + ".object", now, &drawn);
    find_files(object, std::filesystem::path(recipe_.file).parent_path().string());
    object.set("class", ConfigNode::text(of.class_name));
    if (of.up_m.given()) {
      const double up_m = draw_number(of.up_m, path + ".up_m", now, -kFarAway_m, kFarAway_m);
      object.set("position_m", list_of({place[0], place[1], up_m}));
    } else {
      ConfigNode on = object.find("on_seabed") != nullptr ? *object.find("on_seabed") : ConfigNode::map();
      on.set("at_m", list_of({place[0], place[1]}));
      object.set("on_seabed", std::move(on));
    }
    for (auto& [key, value] : drawn)
      scene_.drawn.emplace_back(name + key.substr((path + ".object").size()), std::move(value));
    scene_.sets.push_back("objects." + name + "=" + to_json(object));
    scene_.things.push_back({name, of.name, of.class_name, labelled, place, std::move(object)});
  }

  const Recipe& recipe_;
  Scene& scene_;
  std::vector<std::array<double, 2>> places_;
};

}  // namespace

std::string split_of(const Recipe& recipe, std::uint64_t scene) {
  const double at = even(recipe.seed, scene)[1];
  if (at < recipe.splits.train) return "train";
  return at < recipe.splits.train + recipe.splits.val || recipe.splits.test == 0.0 ? "val" : "test";
}

std::vector<std::string> empty_splits(const Recipe& recipe, std::uint64_t scenes) {
  std::map<std::string, double> shares{
      {"train", recipe.splits.train}, {"val", recipe.splits.val}, {"test", recipe.splits.test}};
  for (std::uint64_t scene = 0; scene < scenes; ++scene) shares.erase(split_of(recipe, scene));
  std::vector<std::string> empty;
  for (const auto& [name, share] : shares) {
    if (share > 0.0) empty.push_back(name);
  }
  return empty;
}

std::optional<std::size_t> kind_of(const Recipe& recipe, std::uint64_t number) {
  const double at = even(recipe.seed, number)[0];
  if (at < recipe.empty_share || recipe.objects.empty()) return std::nullopt;
  const std::vector<std::string> classes = recipe.classes();
  const double part = (at - recipe.empty_share) / (1.0 - recipe.empty_share) * static_cast<double>(classes.size());
  const std::size_t of = std::min(static_cast<std::size_t>(part), classes.size() - 1);
  double rest = part - static_cast<double>(of), sum = 0.0;
  for (const Kind& kind : recipe.objects) sum += kind.class_name == classes[of] ? kind.weight : 0.0;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < recipe.objects.size(); ++i) {
    if (recipe.objects[i].class_name != classes[of] || recipe.objects[i].weight == 0.0) continue;
    last = i;
    rest -= recipe.objects[i].weight / sum;
    if (rest < 0.0) break;
  }
  return last;
}

Scene draw_scene(const Recipe& recipe, std::uint64_t number) {
  Scene scene{.number = number, .split = split_of(recipe, number)};
  const auto bits = random::Stream(recipe.seed, "dataset/seed").bits(number);
  scene.seed = bits[0] | std::uint64_t{bits[1] & 0x1fffffU} << 32;  // 53 bits: JSON's numbers hold it
  scene.sets.push_back(fmt::format("seed={}", scene.seed));
  const Counter at{.seed = recipe.seed, .scene = number, .split = scene.split};
  for (const auto& entry : recipe.args.tree.entries) {
    const ConfigNode value = draw(entry.value, "args." + entry.key, at, &scene.drawn);
    scene.args.push_back(entry.key + "=" + (value.is_scalar() ? value.scalar : to_json(value)));
  }
  for (const auto& entry : recipe.draw.tree.entries)
    scene.sets.push_back(entry.key + "=" + to_json(draw(entry.value, "draw." + entry.key, at, &scene.drawn)));

  Placer placer(recipe, scene);
  const auto samples = static_cast<std::uint64_t>(recipe.samples);
  const random::Stream shift(recipe.seed, "dataset/shift");
  for (std::uint64_t i = 0; i < samples; ++i) {
    Sample sample{.number = number * samples + i};
    const bool own_place = recipe.picture.chip || i == 0;
    const auto kind = kind_of(recipe, recipe.picture.chip ? sample.number : number);
    if (kind) sample.kind = recipe.objects[*kind].name;
    sample.place = own_place ? placer.group(i, sample.kind) : scene.samples[0].place;
    for (std::uint64_t axis = 0; axis < 2; ++axis) sample.shift[axis] = 2.0 * shift.uniform(number, i, axis) - 1.0;
    scene.samples.push_back(std::move(sample));
  }
  return scene;
}

std::vector<Scene> pairs_of(const Recipe& recipe, const Scene& scene) {
  std::vector<Scene> pairs;
  for (const PairKeys& keys : recipe.pairs) {
    Scene& pair = pairs.emplace_back(scene);
    pair.pair = keys.name;
    for (const auto& entry : keys.draw.tree.entries) {
      const std::string path = "pairs." + keys.name + ".draw." + entry.key;
      const Counter at{.seed = recipe.seed, .scene = scene.number, .split = scene.split};
      pair.sets.push_back(entry.key + "=" + to_json(draw(entry.value, path, at, &pair.drawn)));
    }
    for (const Thing& thing : scene.things) {
      if (thing.labelled ? keys.without_objects() : keys.without_clutter())
        pair.sets.push_back("objects." + thing.name + ".absent=true");
    }
    if (keys.without_objects()) {
      for (Sample& sample : pair.samples) sample.kind.clear();
    }
  }
  return pairs;
}

}  // namespace ensonify::dataset
