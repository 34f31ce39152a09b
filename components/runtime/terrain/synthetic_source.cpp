#include "components/runtime/terrain/synthetic_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ensonify::source {

SyntheticSource::SyntheticSource(const terrain::SyntheticSeabedParameters& parameters, const Extent& extent,
                                 const frames::Geodetic& origin, double post_spacing_m)
    : seabed_(parameters), extent_(extent), origin_(origin), post_spacing_m_(post_spacing_m) {
  constexpr int kProbes = 256;  // per side: enough for the range of depths that a chart tells
  lowest_m_ = std::numeric_limits<double>::max();
  highest_m_ = std::numeric_limits<double>::lowest();
  for (int j = 0; j <= kProbes; ++j) {
    for (int i = 0; i <= kProbes; ++i) {
      const double height = seabed_.height_m(extent_.west_m + (extent_.east_m - extent_.west_m) * i / kProbes,
                                             extent_.south_m + (extent_.north_m - extent_.south_m) * j / kProbes);
      lowest_m_ = std::min(lowest_m_, height);
      highest_m_ = std::max(highest_m_, height);
    }
  }
}

void SyntheticSource::sample(const PostBlock& posts, std::span<float> height_m,
                             std::span<std::uint8_t> sediment) const {
  std::size_t k = 0;
  for (int row = 0; row < posts.rows; ++row) {
    for (int column = 0; column < posts.columns; ++column, ++k) {
      const Vec2 place(posts.east_m(column), posts.north_m(row));
      const bool known = extent_.contains(place);
      height_m[k] =
          known ? static_cast<float>(seabed_.height_m(place.x(), place.y())) : std::numeric_limits<float>::quiet_NaN();
      sediment[k] = known ? static_cast<std::uint8_t>(seabed_.sediment(place.x(), place.y())) : std::uint8_t{0};
    }
  }
}

double SyntheticSource::height_m(const Vec2& place) const {
  return extent_.contains(place) ? seabed_.height_m(place.x(), place.y()) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace ensonify::source
