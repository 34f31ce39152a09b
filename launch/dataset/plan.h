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

/// The launches of these scenes. `base`: what else decides their results, id_of() the recipe's launch. They are written
/// as `folder`/launch.yaml with arguments.
std::vector<batch::Job> jobs_of(const Recipe& recipe, const std::vector<Scene>& scenes, const std::string& base,
                                const std::string& folder);

/// Writes into the folder what the jobs and who joins their pictures read: launch.yaml; recipe.json, the recipe as it
/// counts for pictures; scenes.jsonl, a scene in each line.
struct PlanOptions {
  bool keep = false;         // runs keep their records
  bool same_ground = false;  // the seabed of all scenes is one, whatever their seed
};
void write_plan(const Recipe& recipe, const std::vector<Scene>& scenes, const std::vector<batch::Job>& jobs,
                const std::string& folder, const PlanOptions& options);

}  // namespace ensonify::dataset
