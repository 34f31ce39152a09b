#include "kernels/vehicle/vertical/floating.h"

namespace ensonify::vertical {

Floating::Floating(const Tide& tide, const std::optional<Loading>& loading, double speed_mps, double t_s)
    : tide_(tide), loading_(loading), settling_(settlement_m(speed_mps)), t_s_(t_s) {}

double Floating::settlement_m(double speed_mps) const {
  return loading_ ? sinkage_m({loading_->settlement, 0.0, 0.0}, speed_mps, 0.0) : 0.0;
}

void Floating::advance(double speed_mps, double t_s) {
  settling_.advance(settlement_m(speed_mps), t_s - t_s_);
  t_s_ = t_s;
}

Level Floating::at_last() const {
  const double change_m = loading_ ? loading_->change_m : 0.0, change_mps = loading_ ? loading_->rate_mps : 0.0;
  const Level level = tide_.at(t_s_);
  return {level.height_m - (settling_.lower_m() + change_m + change_mps * t_s_),
          level.rate_mps - (settling_.rate_mps() + change_mps),
          level.acceleration_mps2 - settling_.acceleration_mps2()};
}

}  // namespace ensonify::vertical
