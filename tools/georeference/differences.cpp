#include "tools/georeference/differences.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ensonify::georeference_tool {
namespace {

Differences::Spread spread_of(const std::vector<float>& values) {
  if (values.empty()) return {};
  std::vector<float> sizes;
  for (const float value : values) sizes.push_back(std::abs(value));
  const auto p95 = sizes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, p95);
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return {mean, static_cast<double>(*p95), static_cast<double>(std::ranges::max(sizes))};
}

}  // namespace

void Differences::add(const survey_files::Placed& placed) {
  const frames::Vec3 off = placed.place_m - placed.recorded_m;
  down_m_.push_back(static_cast<float>(off.z()));
  level_m_.push_back(static_cast<float>(off.head<2>().norm()));
}

Differences::Spread Differences::vertical() const { return spread_of(down_m_); }
Differences::Spread Differences::horizontal() const { return spread_of(level_m_); }

}  // namespace ensonify::georeference_tool
