#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "kernels/base/frames/local_projection.h"

namespace ensonify::survey_files {

/// Positions of a vessel by time.
class Fixes {
 public:
  /// What is no place on the globe is left out, and 0, 0, which files have before the first fix.
  void add(std::int64_t unix_ns, const frames::Geodetic& place);
  bool empty() const { return fixes_.empty(); }

  /// A map about the first place. Not while it is empty.
  const frames::LocalProjection& projection() const;
  /// On that map: straight between fixes, and the nearest outside them.
  frames::Vec2 enu_at(std::int64_t unix_ns) const;

  static bool is_known(const frames::Geodetic& place);

 private:
  std::map<std::int64_t, frames::Geodetic> fixes_;
  mutable std::optional<frames::LocalProjection> projection_;
};

}  // namespace ensonify::survey_files
