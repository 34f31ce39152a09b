#include "kernels/vehicle/vertical/draught.h"

namespace ensonify::vertical {
namespace {

constexpr double kKnot_mps = 1852.0 / 3600.0;

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

}  // namespace

double sinkage_m(const Loading& loading, double speed_mps, double t_s) {
  return settlement_m(loading.settlement, speed_mps) + loading.change_m + loading.rate_mps * t_s;
}

double barrass_squat_m(double block_coefficient, double speed_mps) {
  const double knots = speed_mps / kKnot_mps;
  return block_coefficient * knots * knots / 100.0;
}

}  // namespace ensonify::vertical
