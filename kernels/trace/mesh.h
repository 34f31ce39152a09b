#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernels/lod/patch.h"
#include "kernels/terrain/tile.h"

/// What rays are traced against. Private to this folder: it includes Embree.
namespace ensonify::trace {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, SceneRelease>;

/// One instruction set everywhere that results must match. No number of threads: Embree would hold the whole process's
/// TBB to it.
Device new_device();

/// Throws std::runtime_error with what could not be done when Embree reports an error.
void check(const Device& device, const char* fault);

/// A patch of a tile, built once.
struct Part {
  EmbreeScene scene;
  RTCBounds bounds{};
  const terrain::Tile* tile = nullptr;
  std::uint32_t number = 0;  // of the tile, as Hit has it
  float facet_m = 0.0F;      // spacing of its posts
  std::size_t triangles = 0;
};

/// A patch without triangles has no scene.
Part part_of(const Device& device, const lod::Patch& patch);

/// The parts that make the seabed of a ping, over which Embree keeps a tree of their bounds. A scene of its own holds
/// all grids of a part: Embree builds a scene of grids as a whole, so in one scene of all parts nothing would stay.
/// Rays enter a part as they are, without the transformation of an instance.
class Mesh {
 public:
  /// The parts must outlive the mesh or the next call.
  void assign(const Device& device, std::span<const Part* const> parts);

  /// Null without parts.
  RTCScene scene() const { return scene_.get(); }
  /// By the instance number of a hit.
  const Part& part(unsigned number) const { return *parts_[number]; }

 private:
  static void bound(const RTCBoundsFunctionArguments* of);
  static void intersect(const RTCIntersectFunctionNArguments* of);

  std::vector<const Part*> parts_;
  EmbreeScene scene_;
};

}  // namespace ensonify::trace
