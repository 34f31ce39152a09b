#pragma once

#include <memory>
#include <vector>

#include "components/terrain/terrain_source.h"
#include "kernels/mesh/solids/solid.h"
#include "scenarios/world/objects.h"

namespace ensonify::source {

/// A cable or chain that lies along the seabed, or spans its hollows (solids::laid_heights).
class LaidLine {
 public:
  /// Of one of its sections: the whole line is laid. Throws ConfigError where the ground ends or has a hole.
  LaidLine(const SceneObject& section, const TerrainSource& ground);

  /// One section where it lies, about an origin near it.
  solids::Surface surface(const SceneObject& section) const;

 private:
  frames::Vec3 at(double along_m) const;

  std::shared_ptr<const LaidRoute> route_;
  std::vector<double> along_m_;   // places that heights are known of
  std::vector<double> height_m_;  // of its middle line
};

}  // namespace ensonify::source
