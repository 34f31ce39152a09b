#pragma once

#include <array>
#include <memory>
#include <variant>
#include <vector>

#include "kernels/mesh/progressive/hierarchy.h"

/// Bodies of simple shape. Each stands about its middle: x east, y north, z up before it is turned.
namespace ensonify::solids {

struct Sphere {
  double diameter_m = 0.0;
};

/// A cuboid of these sides along x, y and z.
struct Box {
  frames::Vec3 size_m = frames::Vec3::Zero();
};

/// Straight, its axis along y, closed at both ends.
struct Cylinder {
  double diameter_m = 0.0;
  double length_m = 0.0;
};

/// A rectangle without thickness that lies level: sides along x and y. Both of its faces scatter.
struct Plate {
  frames::Vec2 size_m = frames::Vec2::Zero();
};

/// Upright, closed at both ends; a top of 0 m is a point.
struct Cone {
  double diameter_m = 0.0;
  double top_diameter_m = 0.0;
  double height_m = 0.0;
};

/// A round tube in a ring that lies level.
struct Tyre {
  double diameter_m = 0.0;  // over all
  double width_m = 0.0;     // of the tube
};

/// A tube, open at both ends, its axis along y.
struct Pipe {
  double diameter_m = 0.0;  // over all
  double length_m = 0.0;
  double wall_m = 0.0;
};

/// A bottle that lies: its axis along y, its neck to the north.
struct Bottle {
  double diameter_m = 0.0;
  double length_m = 0.0;
};

/// A shell or a bomb that lies: a body along y with a tangent ogive to the north and a tail that tapers to the south.
struct Shell {
  double diameter_m = 0.0;
  double length_m = 0.0;
};

/// A ramp of these extents along x, y and z: it rises to the north.
struct Wedge {
  frames::Vec3 size_m = frames::Vec3::Zero();
};

/// A rope, hose or cable that hangs between two ends along y: a catenary, straight without sag.
struct Cable {
  double diameter_m = 0.0;
  double length_m = 0.0;  // from end to end
  double sag_m = 0.0;
};

/// Links of ship's chain that hang so.
struct Chain {
  double wire_m = 0.0;  // diameter of the links' wire
  double length_m = 0.0;
  double sag_m = 0.0;
};

/// A thing made of several simple bodies (figure.h), with these extents along x, y and z.
struct Figure {
  enum class Kind {
    kLadder,
    kTrap,
    kAnchor,
    kMooring,
    kPerson,
    kBoat,
    kAircraft,
    kPropeller,
    kNet,
    kHook,
    kValve,
    kSheetPiles,
    kWreck,
    kBrokenAircraft
  };
  Kind kind = Kind::kLadder;
  frames::Vec3 size_m = frames::Vec3::Zero();
};

/// Triangles of a file about their middle, which others may share.
struct Mesh {
  std::shared_ptr<const progressive::TriangleMesh> triangles;
  bool closed = false;  // counterclockwise as seen from outside
  double scale = 1.0;
};

using Solid =
    std::variant<Sphere, Box, Cylinder, Plate, Cone, Tyre, Pipe, Bottle, Shell, Wedge, Cable, Chain, Figure, Mesh>;

/// Whether only one side of its surface can be seen: a plate has two.
bool is_closed(const Solid& solid);

/// Half its greatest extent: of the smallest ball about its middle that holds it.
double radius_m(const Solid& solid);

/// A surface as triangles, and how those that stand for a curved one bulge: heights over the middles of their edges,
/// the first from the first corner to the second, outwards. No bulges: all of it is flat.
struct Surface {
  progressive::TriangleMesh mesh;
  std::vector<std::array<float, 3>> bulge_m;  // by triangle
};

/// Its surface, corners counterclockwise as seen from outside (of a plate: from above), with its middle for origin.
/// Flat faces are as few triangles as they can be; curved ones have their corners on the surface, and no triangle lies
/// farther from it than `sagitta_m`. Throws std::invalid_argument for a size or sagitta that is not above 0, and where
/// it would take more than a million triangles.
Surface surface_of(const Solid& solid, double sagitta_m);

/// Volume of a closed mesh below a height (z of its own frame), m^3, by the divergence theorem: exact but for rounding.
double volume_below_m3(const progressive::TriangleMesh& mesh, double height_m);

/// The height below which this share of a closed mesh's volume lies, 0..1; of a mesh without volume, as a plate that
/// lies level, the share of its heights. Within a millionth of the mesh's own height.
double height_of_share_m(const progressive::TriangleMesh& mesh, double share);

}  // namespace ensonify::solids
