#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/acoustics/trace/packet.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/water/refraction/path_table.h"

/// Sixteen bent rays side by side. Private to this folder, as packet.h is.
namespace ensonify::trace {

/// The depths between which there is geometry.
struct Band {
  double top_m;
  double bottom_m;
};

constexpr double kOffArc_m = 0.8e-3;  // a chord is nowhere farther from its arc

/// Chords overlap by this, so that no ray slips through where they join: floats round by 0.13 mm (scene.h), which at
/// half a degree of grazing is 15 mm along the ray. A chord prolonged so far leaves the arc by well under 0.1 mm.
constexpr double kOverlap_m = 0.05;

/// Layers of water that have geometry, from the level of a table down: in each a path is one arc.
class Layers {
 public:
  struct Layer {
    double height_m, gradient_per_s, top_mps, bottom_mps, jump_per_s;  // jump: of the gradient, to the one below
    double top_depth_m;
  };
  /// None where the level is within the band.
  Layers(const refraction::PathTable& paths, const Band& band);
  bool empty() const { return layers_.empty(); }
  std::size_t size() const { return layers_.size(); }
  const Layer& operator[](std::size_t i) const { return layers_[i]; }

 private:
  std::vector<Layer> layers_;
};

/// Rays whose paths the table serves, and which go down through each layer in one chord: nearly all of them. The same
/// arcs as Path has, in columns.
class BentPacket {
 public:
  struct Source {
    const refraction::PathTable& paths;
    const Layers& layers;
    Eigen::Matrix3d enu_from_head;
    frames::Vec3 head_enu_m, start_m;  // start: the head in Embree's frame
    double max_length_m, slowness_spm;
  };

  /// Rays first..first + count - 1, at the level. False where one of them is not served: then none is.
  bool aim(const Source& source, const Rays& rays, std::size_t first, std::size_t count);

  /// Their chords through the layer that they come to, as lanes of a packet. False where one of them needs more: then
  /// those that have hit nothing so far (left()) are to be traced otherwise. So what a ray hits, to the bit, never
  /// depends on what others hit.
  bool cross(const Source& source, Packet& packet);

  /// What they hit there, into their rows; those that hit something in the first layer, or nothing, have theirs anew.
  void note(const Source& source, const Packet& packet, Hits& hits) const;

  /// Of the lanes: which have hit nothing so far.
  const std::array<std::int32_t, kPacket>& left() const { return on_; }

  /// On to the next layer; false where there is none, or all have hit something.
  bool go_on(const Source& source, const Packet& packet);

 private:
  using Column = refraction::LevelPaths::Column;
  static_assert(refraction::LevelPaths::kLanes == kPacket);

  std::size_t first_ = 0, layer_ = 0;
  alignas(64) std::array<std::int32_t, kPacket> on_;
  refraction::LevelPaths at_;  // the layer's top
  alignas(64) Column slowness_east_, slowness_north_, chord_east_, chord_north_, chord_up_, length_m_, end_sine_;
};

}  // namespace ensonify::trace
