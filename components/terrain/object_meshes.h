#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "components/terrain/laid_line.h"
#include "components/terrain/terrain_source.h"
#include "scenarios/world/objects.h"

namespace ensonify::source {

/// A shape of triangles, in metres about its middle.
struct ObjectMeshFile {
  std::int64_t number = 0;  // in the order of first use
  solids::Mesh mesh;
  std::string said;                                  // what was guessed or mended; empty: nothing
  frames::Vec3 middle_enu_m = frames::Vec3::Zero();  // of a laid line's section
};

/// The shapes of a scenario's objects that come from files, and of those that are laid. Each file is read once, however
/// many objects are of it; a laid line is laid once, however many sections it has.
class ObjectMeshes {
 public:
  /// The shape of an object that has a file. Equal places become one vertex. What is turned inside out is turned back;
  /// what has an open edge has two sides. Throws ConfigError for a file that cannot be read or used.
  const ObjectMeshFile& of(const SceneObject& object);

  /// The shape of a section of a laid line on this ground. Throws ConfigError where the ground ends or has a hole.
  const ObjectMeshFile& laid(const SceneObject& object, const TerrainSource& ground);

 private:
  using Key = std::tuple<std::string, double, bool>;
  std::map<Key, ObjectMeshFile> meshes_;
  std::map<std::shared_ptr<const LaidRoute>, LaidLine> lines_;
};

}  // namespace ensonify::source
