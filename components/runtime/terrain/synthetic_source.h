#pragma once

#include "components/runtime/terrain/terrain_source.h"
#include "kernels/terrain/synthetic_seabed.h"

namespace ensonify::source {

/// The generated seabed of a scenario, cut off at a rectangle.
class SyntheticSource : public TerrainSource {
 public:
  SyntheticSource(const terrain::SyntheticSeabedParameters& parameters, const Extent& extent,
                  const frames::Geodetic& origin, double post_spacing_m);

  Extent extent() const override { return extent_; }
  double lowest_m() const override { return lowest_m_; }
  double highest_m() const override { return highest_m_; }
  frames::Geodetic origin() const override { return origin_; }
  double native_spacing_m() const override { return post_spacing_m_; }
  void sample(const PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const override;
  double height_m(const Vec2& place) const override;

 private:
  terrain::SyntheticSeabed seabed_;
  Extent extent_;
  frames::Geodetic origin_;
  double post_spacing_m_;
  double lowest_m_;
  double highest_m_;
};

}  // namespace ensonify::source
