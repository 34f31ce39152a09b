#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "scenarios/world/objects.h"

namespace ensonify::source {

/// A shape from a file, in metres about its middle.
struct ObjectMeshFile {
  std::int64_t number = 0;  // in the order of first use
  solids::Mesh mesh;
  std::string said;  // what was guessed or mended; empty: nothing
};

/// The shapes of a scenario's objects that come from files. Each file is read once, however many objects are of it.
class ObjectMeshes {
 public:
  /// The shape of an object that has a file. Equal places become one vertex. What is turned inside out is turned back;
  /// what has an open edge has two sides. Throws ConfigError for a file that cannot be read or used.
  const ObjectMeshFile& of(const SceneObject& object);

 private:
  using Key = std::tuple<std::string, double, bool>;
  std::map<Key, ObjectMeshFile> meshes_;
};

}  // namespace ensonify::source
