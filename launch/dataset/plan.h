#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "launch/batch/job.h"
#include "launch/dataset/scenes.h"

namespace ensonify::dataset {

/// Which scenes a folder is for.
struct Extent {
  std::uint64_t pictures = 1;
  std::uint64_t first_scene = 0, scenes = 1;

  /// The first so many pictures.
  static Extent of(const Recipe& recipe, std::uint64_t pictures);
  /// The scene of one picture.
  static Extent around(const Recipe& recipe, std::uint64_t number);
};

/// The launches of these scenes. `base`: what else decides their results, id_of() the recipe's launch.
std::vector<batch::Job> jobs_of(const Recipe& recipe, const std::vector<Scene>& scenes, const std::string& base);

/// Scenes as who makes their pictures reads them: a line of JSON for each. same_ground: their seabed is one, whatever
/// their seed.
std::vector<std::string> lines_of(const std::vector<Scene>& scenes, const std::vector<batch::Job>& jobs,
                                  bool same_ground);

/// Writes into the folder what who makes pictures reads: recipe.json, the recipe as it counts for pictures;
/// scenes.jsonl, these lines.
void write_plan(const Recipe& recipe, const std::vector<std::string>& lines, const std::string& folder);

}  // namespace ensonify::dataset
