#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kernels/base/frames/attitude.h"
#include "kernels/seabed/relief/bodies.h"
#include "kernels/seabed/relief/marks.h"
#include "kernels/seabed/relief/mask.h"
#include "kernels/seabed/relief/ripples.h"
#include "kernels/seabed/relief/seabed.h"
#include "kernels/seabed/relief/shapes.h"
#include "kernels/seabed/relief/spectrum.h"

/// The layers of a generated seabed as a scenario states them (scenarios/layers.md). Numbers are those of
/// kernels/seabed/relief, in SI; names refer to layers further up in the list.
namespace ensonify::layers {

/// Mask of a layer: everywhere that all given terms allow. Without terms: everywhere.
struct Mask {
  /// Depth, slope and curvature are those of the seabed up to and with this layer; "": the first one.
  std::string of;
  double scale_m = 2.0;  // at which depth, slope, curvature and sediment are examined, > 0
  std::optional<relief::Band> depth_m, slope, curvature_1pm;
  std::vector<frames::Vec2> polygon_enu_m;
  double polygon_softness_m = 0.0;
  std::vector<std::uint8_t> sediments;  // classes that the layers above this one in the list gave

  /// Irregular patches of a typical size that cover a share of everything.
  struct Patches {
    double length_m = 50.0;
    double share = 0.5;     // 0 to 1
    double softness = 0.1;  // width of the border, in standard deviations of the noise that draws it
  };
  std::optional<Patches> patches;
  std::vector<Mask> any;  // at least one of these holds
  bool reverse = false;   // where all this does not hold
};

/// Relief of a spectrum, plain or multifractal.
struct Spectral {
  relief::Spectrum spectrum;
  double mean_m = 0.0;
  double intermittency = 0.0;
  double height_gain = 0.0;
  std::optional<Mask> rough;  // amplitude 1 where it holds and `smooth` elsewhere, octave by octave: no step in height
  double smooth_amplitude = 0.0;
};

/// A macro shape from a file: a raster that GDAL reads, or a tile set.
struct Guide {
  std::string raster, tiles_folder;  // one of them, as found on disk
  bool values_are_depths = false;
  double cell_m = 5.0;  // of the copy in memory
};

/// Detail that a guide of coarse cells lacks (relief::detail_below).
struct Restored {
  std::string guide;  // the layer
  double hurst = 0.625;
  double band_start_cells = 2.0;
};

/// A channel or valley: a ceiling over the seabed.
struct Dredged {
  std::vector<frames::Vec3> line_enu_m;
  double half_width_m = 10.0;
  double side_slope = 0.2;
};

/// No height: gives a sediment class where the mask holds.
struct Paint {};

using Form =
    std::variant<Paint, relief::Plane, relief::Ramp, relief::Wave, relief::Sphere, relief::Ridge, Spectral,
                 relief::RippleParameters, relief::BodyParameters, relief::MarkParameters, Dredged, Guide, Restored>;

struct Layer {
  std::string name;  // also of its random numbers: another layer's name or place in the list changes nothing here
  bool used = true;
  Form form;
  relief::Layer::Join join = relief::Layer::Join::kAdd;
  std::string above;  // kCover, kCut: height counts from the seabed up to and with this layer; "": from chart datum
  std::optional<Mask> mask;
  std::optional<std::uint8_t> sediment;
  double shows_above_m = 0.0;
};

}  // namespace ensonify::layers
