#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernels/acoustics/trace/contributors.h"
#include "kernels/mesh/lod/cover.h"
#include "kernels/mesh/lod/hierarchy.h"
#include "kernels/mesh/tile.h"

/// Geometry that rays are traced against. Private to this folder: it includes Embree.
namespace ensonify::trace {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct GeometryRelease {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, SceneRelease>;
using Geometry = std::unique_ptr<RTCGeometryTy, GeometryRelease>;

/// One instruction set everywhere that results must match. No number of threads: Embree would hold the whole process's
/// TBB to it.
Device new_device();

/// Throws std::runtime_error with what could not be done when Embree reports an error.
void check(RTCDevice device, const char* fault);

/// A piece of the seabed as an Embree scene, which is built when it is first asked for.
class Part {
 public:
  virtual ~Part();
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  /// Threads may ask at once: they build it twice, and one is kept. Throws when there is no memory for it; it may be
  /// asked again.
  RTCScene scene() const;
  /// Around the scene, built or not.
  const RTCBounds& bounds() const { return bounds_; }
  /// 0 before it is built.
  std::size_t triangles() const;

  /// As Hit has them.
  std::uint32_t number() const { return number_; }
  float facet_m() const { return facet_m_; }
  std::uint32_t contributor_at(const terrain::Vec2& place_enu_m) const {
    return contributor_ != kNoise ? contributor_ : contributor_of(place_enu_m);
  }
  bool is_body() const { return trace::is_body(contributor_); }

 protected:
  struct Content {
    Geometry geometry;  // with its buffers, not yet committed
    std::size_t triangles;
  };
  /// `contributor` is that of all places, or kNoise where they differ.
  Part(RTCDevice device, const RTCBounds& bounds, std::uint32_t number, float facet_m, std::uint32_t contributor);
  virtual Content content() const = 0;
  virtual std::uint32_t contributor_of(const terrain::Vec2& /*place_enu_m*/) const { return contributor_; }
  RTCDevice device() const { return device_; }
  /// Memory of Embree's for count elements of one of a geometry's buffers. Throws std::bad_alloc.
  void* new_buffer(const Geometry& geometry, RTCBufferType type, RTCFormat format, std::size_t element_bytes,
                   std::size_t count) const;

 private:
  struct Built;
  const Built* build() const;

  RTCDevice device_;
  RTCBounds bounds_;
  std::uint32_t number_;
  float facet_m_;
  std::uint32_t contributor_;
  mutable std::atomic<const Built*> built_ = nullptr;
};

/// On all sides of a part: without it one ray in ten million that runs along the border of two parts is lost between
/// them.
constexpr float kPartSlack_m = 1e-3F;

/// A tile as a scene has it. Parts and meshes share it, so that it outlives the scene's use of it.
struct Ground {
  terrain::Tile tile;
  lod::Hierarchy hierarchy;
};

/// Mesh of a block.
struct Shown {
  std::shared_ptr<const Ground> ground;
  std::uint32_t number = 0;  // of the tile, as Hit has it
  lod::Leaf leaf;
  lod::Rim rim{};
};

/// A leaf of a tile's cover.
class BlockPart final : public Part {
 public:
  BlockPart(const Device& device, const Shown& shown, const terrain::Vec2& origin_enu_m);

 private:
  Content content() const override;
  std::uint32_t contributor_of(const terrain::Vec2& place_enu_m) const override;

  Shown shown_;
  terrain::Vec2 origin_enu_m_;
};

/// The parts that make the seabed of a ping, over which Embree keeps a tree of their bounds. A scene of its own holds
/// all grids of a part: Embree builds a scene of grids as a whole, so in one scene of all parts nothing would stay.
/// Rays enter a part as they are, without the transformation of an instance.
class PartTree {
 public:
  PartTree() = default;
  PartTree(const Device& device, std::vector<std::shared_ptr<const Part>> parts);
  PartTree(const PartTree&) = delete;  // Embree knows where its parts are
  PartTree& operator=(const PartTree&) = delete;

  enum class Of { kAll, kSeabed };  // seabed: all but bodies
  /// The nearest facet of these for each lane of a packet that is on, by instance number. Throws what kept a part from
  /// being built when a ray came to it; the packet is then void.
  void intersect(const int* on, RTCRayHit16& rays, Of of = Of::kAll) const;
  /// By the instance number of a hit.
  const Part& part(unsigned number) const { return *parts_[number]; }

 private:
  static void bound(const RTCBoundsFunctionArguments* of);
  static void enter(const RTCIntersectFunctionNArguments* of);

  std::vector<std::shared_ptr<const Part>> parts_;
  EmbreeScene scene_;
};

}  // namespace ensonify::trace
