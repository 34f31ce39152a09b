#include "components/formats/time_of_day.h"

#include <cmath>

namespace ensonify::formats {

double time_of_day_step_s(double from_s, double to_s) {
  const double step_s = std::remainder(to_s - from_s, kDay_s);
  if (from_s >= kDay_s && to_s < 0.5 * kDay_s && step_s <= 0.0) return step_s + 1.0;
  if (to_s >= kDay_s && from_s < 0.5 * kDay_s && step_s >= 0.0) return step_s - 1.0;
  return step_s;
}

}  // namespace ensonify::formats
