#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/config/config_error.h"
#include "kernels/mesh/solids/solid.h"

namespace ensonify {

/// Where an object stands: its middle anywhere, or on the seabed.
struct ObjectPlace {
  frames::Vec3 position_enu_m = frames::Vec3::Zero();  // up only where it hangs
  std::optional<double> buried_share;                  // of its volume, 0..1
  bool rests = false;                                  // lies on the seabed in balance, turned by its heading only
  double heading_rad = 0.0;                            // of its y axis, clockwise from north
  double tilt_rad = 0.0;                               // of its upright from the vertical
  double tilt_heading_rad = 0.0;                       // towards which it leans, clockwise from north

  /// Turned by its heading, then tilted towards the heading of its tilt.
  Eigen::Matrix3d enu_from_object() const;
};

/// Where a shape is read from, in the place of a solid.
struct ObjectFile {
  std::string path;
  std::optional<double> unit_m;  // of the file; nothing: guessed by its size
  bool y_is_up = false;          // else z
};

/// The way on which a line lies along the seabed, straight from place to place.
struct LaidRoute {
  std::vector<frames::Vec2> through_enu_m;
  double taut_m = 0.0;  // its tension over the weight of a metre of it in water; 0: limp
  double buried = 0.0;  // share of its diameter
};

/// The position so far along a route; beyond its ends they.
frames::Vec2 position_on(const LaidRoute& route, double along_m);

/// A section of a laid line: from here to there along its route.
struct LaidSection {
  std::shared_ptr<const LaidRoute> route;
  double from_m = 0.0, to_m = 0.0;
};

/// A thing that is known one by one: it has a class and a number of its own in labels.
struct SceneObject {
  std::string name;
  std::string class_name;      // of labels
  std::uint32_t class_id = 0;  // from 1, in the order in which the scenario's classes come
  std::uint32_t instance = 0;  // from 1, in the scenario's order
  solids::Solid solid;         // of a file: a mesh without triangles
  std::optional<ObjectFile> file;
  std::optional<LaidSection> laid;  // a cable or chain whose shape follows from the seabed
  ObjectPlace place;
  bool smooth = false;        // its echo follows from its shape alone; else it scatters as its sediment
  std::uint8_t sediment = 0;  // one of Seabed::sediments
  bool absent = false;        // not there, and all else as if it were, bit for bit
  ConfigPlace written;        // for messages
};

}  // namespace ensonify
