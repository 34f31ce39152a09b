#include "kernels/vehicle/vertical/floating.h"

#include <cmath>

namespace ensonify::vertical {
namespace {

double settlement_m(const std::vector<Sinkage>& table, double speed_mps) {
  if (table.empty()) return 0.0;
  if (speed_mps <= table.front().speed_mps) return table.front().lower_m;
  for (std::size_t i = 1; i < table.size(); ++i) {
    if (speed_mps > table[i].speed_mps) continue;
    const double slope = (table[i].lower_m - table[i - 1].lower_m) / (table[i].speed_mps - table[i - 1].speed_mps);
    return table[i - 1].lower_m + slope * (speed_mps - table[i - 1].speed_mps);
  }
  return table.back().lower_m;
}

constexpr double kW = 1.0;  // 1/s

}  // namespace

double sinkage_m(const Loading& loading, double speed_mps, double t_s) {
  return settlement_m(loading.settlement, speed_mps) + loading.change_m + loading.rate_mps * t_s;
}

void Settling::advance(double target_m, double dt_s) {
  if (dt_s <= 0.0) return;
  // u = u0 + k t is followed 2 k / w behind; what is off that dies away as (a + b t) exp(-w t).
  const double k = (target_m - target_m_) / dt_s;
  const double a = lower_m_ - target_m_ + 2.0 * k / kW;
  const double b = rate_mps_ - k + kW * a;
  const double gone = std::exp(-kW * dt_s);
  lower_m_ = target_m - 2.0 * k / kW + (a + b * dt_s) * gone;
  rate_mps_ = k + (b - kW * (a + b * dt_s)) * gone;
  target_m_ = target_m;
}

double Settling::acceleration_mps2() const { return kW * kW * (target_m_ - lower_m_) - 2.0 * kW * rate_mps_; }

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
