#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "launch/dataset/recipe.h"

namespace ensonify::dataset {

/// A picture: number k of the set is number k % samples of scene k / samples.
struct Sample {
  std::uint64_t number = 0;
  std::string kind;               // of objects; "": it is empty
  std::array<double, 2> place{};  // of a chip's middle, but for its shift: east, north
  std::array<double, 2> shift{};  // across and along, -1..1 of the chip's jitter
};

/// A thing of a scene.
struct Thing {
  std::string name, kind, class_name;  // name: in the scenario
  bool labelled = true;
  std::array<double, 2> place{};
  ConfigNode object;  // as the scenario has it
};

/// A launch with what is drawn for it.
struct Scene {
  std::uint64_t number = 0;
  std::string pair;        // of Recipe::pairs; "": the scene itself
  std::uint64_t seed = 1;  // of the scenario
  std::string split;
  std::vector<Sample> samples;
  std::vector<Thing> things;
  Values drawn;                         // by the recipe's keys
  std::vector<std::string> args, sets;  // of `ensonify run`
};

/// Follows from the recipe and the number alone. Throws UserError where there is no room for its things, with the
/// constraint that fails most.
Scene draw_scene(const Recipe& recipe, std::uint64_t number);

/// The same scene once more for each of the recipe's pairs, with what is otherwise there.
std::vector<Scene> pairs_of(const Recipe& recipe, const Scene& scene);

/// Split of a scene.
std::string split_of(const Recipe& recipe, std::uint64_t scene);

/// Kind of the objects of picture (of a chip) or scene (of whole pings) `number`, by its place in recipe.objects;
/// nothing: it is empty. Of any successive numbers the shares are right within a few: of empty ones, of classes, which
/// have equal shares of the rest, and of the kinds of a class, by their weights.
std::optional<std::size_t> kind_of(const Recipe& recipe, std::uint64_t number);

/// Splits that have a share and would get none of so many scenes.
std::vector<std::string> empty_splits(const Recipe& recipe, std::uint64_t scenes);

}  // namespace ensonify::dataset
