#pragma once

#include <optional>

#include "kernels/vehicle/vertical/draught.h"
#include "kernels/vehicle/vertical/settling.h"
#include "kernels/vehicle/vertical/tide.h"

namespace ensonify::vertical {

/// Height at which a vessel floats: on the tide, less the settlement of her speed, as the hull comes to it, and what
/// her load changes. Without a loading it is the tide's own level, which a submerged vehicle rides.
class Floating {
 public:
  /// Settled to its speed through the water at sim time `t_s`.
  Floating(const Tide& tide, const std::optional<Loading>& loading, double speed_mps, double t_s);

  /// On to `t_s` (not before the last), when the speed through the water has come to `speed_mps`.
  void advance(double speed_mps, double t_s);

  Level at_last() const;

 private:
  double settlement_m(double speed_mps) const;

  Tide tide_;
  std::optional<Loading> loading_;
  Settling settling_;
  double t_s_;
};

}  // namespace ensonify::vertical
