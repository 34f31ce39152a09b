#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>

#include "kernels/base/frames/attitude.h"
#include "kernels/mesh/solids/facet.h"

namespace ensonify::trace {

/// A thing that stands on the seabed or hangs in the water, known one by one. It does not move, and is rigid.
struct Body {
  solids::Surface surface;  // where it stands; corners counterclockwise as seen from outside
  bool two_sided = false;   // a surface without a volume: both sides scatter
  /// Its echo follows from its shape alone (echo/smooth_facet.h), and is heard where rays to its own facets arrive.
  /// Else it scatters as its sediment does, with random phase.
  bool smooth = false;
  std::uint8_t sediment = 0;  // class
  /// No ray hits it or goes to it; paths reckon with its box, so that those to all else are as with it, bit for bit.
  bool absent = false;
  // For labels:
  std::uint32_t instance = 0, label_class = 0;
  std::string name, class_name;
  double buried = 0.0;  // part of its volume
  frames::Quaternion enu_from_body = frames::Quaternion::Identity();
};

/// A body as a mesh has it.
struct ShownBody {
  std::shared_ptr<const Body> body;
  std::uint32_t tile = 0;         // its number, as Hit has those of tiles
  std::uint32_t contributor = 0;  // by the direct path
  Eigen::AlignedBox3d box_enu_m;
};

}  // namespace ensonify::trace
