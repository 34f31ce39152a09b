#pragma once

#include <memory>
#include <string>

#include "kernels/base/frames/local_projection.h"

class OGRCoordinateTransformation;

namespace ensonify::grid_tool {

/// The map of a file: transverse Mercator on WGS 84 about its origin, scale 1.
std::string map_about(const frames::Geodetic& origin);

/// The map that a user names: "utm" (of a position), or anything that GDAL takes, such as EPSG:32619. It has to be in
/// metres. Throws UserError.
std::string map_named(const std::string& name, const frames::Geodetic& about);

/// From one map to another.
class Transformation {
 public:
  /// Throws UserError where there is no way.
  Transformation(const std::string& from_wkt, const std::string& to_wkt);
  ~Transformation();
  Transformation(const Transformation&) = delete;
  Transformation& operator=(const Transformation&) = delete;

  /// False where the other map does not reach.
  bool transform(double& x_m, double& y_m) const;

 private:
  std::unique_ptr<OGRCoordinateTransformation, void (*)(OGRCoordinateTransformation*)> way_;  // none: the same map
};

}  // namespace ensonify::grid_tool
