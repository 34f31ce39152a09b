#include "kernels/terrain/synthetic_seabed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ensonify::terrain {
namespace {

/// Mean square of gradient noise with unit gradients and the quintic fade, over a cell and all gradients:
/// 4 * Integral of (w(x) w(y))^2 (x^2 + y^2) / 2, w(t) = 1 - fade(t); the exact integral is 0.0669... (a test holds
/// it).
constexpr double kNoiseMeanSquare = 0.046531;

double fade(double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); }

/// Unit vectors all round, so that the inner loop needs no sines.
const std::array<Vec2, 256>& gradients() {
  static const auto table = [] {
    std::array<Vec2, 256> directions;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(directions.size());
      directions[i] = Vec2(std::cos(angle), std::sin(angle));
    }
    return directions;
  }();
  return table;
}

double gradient_noise(const random::Stream& stream, const Vec2& place, std::uint64_t octave) {
  const double x0 = std::floor(place.x()), y0 = std::floor(place.y());
  const double u = place.x() - x0, v = place.y() - y0;
  const auto corner = [&](int dx, int dy) {
    const auto cell = stream.bits(static_cast<std::uint64_t>(static_cast<std::int64_t>(x0) + dx),
                                  static_cast<std::uint64_t>(static_cast<std::int64_t>(y0) + dy), octave);
    return gradients()[cell[0] & 255U].dot(Vec2(u - dx, v - dy));
  };
  const double south = std::lerp(corner(0, 0), corner(1, 0), fade(u));
  const double north = std::lerp(corner(0, 1), corner(1, 1), fade(u));
  return std::lerp(south, north, fade(v));
}

}  // namespace

SyntheticSeabed::SyntheticSeabed(const SyntheticSeabedParameters& parameters)
    : parameters_(parameters),
      boulders_(parameters.seed, "terrain/boulders"),
      relief_(parameters.seed, "terrain/relief") {}

double SyntheticSeabed::height_m(double x_enu_m, double y_enu_m) const {
  const Vec2 place(x_enu_m, y_enu_m);
  const Vec2 downhill(std::sin(parameters_.downhill_heading_rad), std::cos(parameters_.downhill_heading_rad));
  const double depth_m = parameters_.reference_depth_m +
                         std::tan(parameters_.slope_rad) * (place - parameters_.reference_enu_m).dot(downhill);
  return -depth_m + ridge_m(place) + boulder_m(place) + relief_m(place);
}

Sediment SyntheticSeabed::sediment(double x_enu_m, double y_enu_m) const {
  const Vec2 place(x_enu_m, y_enu_m);
  if (boulder_m(place) > 0.0) return Sediment::kBoulder;
  if (parameters_.ridge.height_m > 0.0 && ridge_m(place) > 0.5 * parameters_.ridge.height_m) return Sediment::kRidge;
  return Sediment::kBase;
}

double SyntheticSeabed::ridge_m(const Vec2& place) const {
  const Ridge& ridge = parameters_.ridge;
  if (ridge.height_m == 0.0) return 0.0;
  const Vec2 axis = ridge.end_enu_m - ridge.start_enu_m;
  const double length2 = axis.squaredNorm();
  const double along = length2 > 0.0 ? std::clamp((place - ridge.start_enu_m).dot(axis) / length2, 0.0, 1.0) : 0.0;
  const double distance2 = (place - ridge.start_enu_m - along * axis).squaredNorm();
  return ridge.height_m * std::exp(-4.0 * std::numbers::ln2 * distance2 / (ridge.width_m * ridge.width_m));
}

double SyntheticSeabed::boulder_m(const Vec2& place) const {
  const Boulders& boulders = parameters_.boulders;
  if (boulders.per_hectare == 0.0) return 0.0;
  const double cell_m = 2.0 * boulders.largest_radius_m;
  const double chance = boulders.per_hectare * cell_m * cell_m / 1e4;
  // A boulder reaches at most half a cell beyond its own: the four cells nearest to the place hold all that matter.
  const double x0 = std::floor(place.x() / cell_m - 0.5), y0 = std::floor(place.y() / cell_m - 0.5);
  double highest_m = 0.0;
  for (int dy = 0; dy <= 1; ++dy) {
    for (int dx = 0; dx <= 1; ++dx) {
      const auto cell = boulders_.bits(static_cast<std::uint64_t>(static_cast<std::int64_t>(x0) + dx),
                                       static_cast<std::uint64_t>(static_cast<std::int64_t>(y0) + dy));
      if (0x1p-32 * cell[0] >= chance) continue;
      const Vec2 centre((x0 + dx + 0x1p-32 * cell[1]) * cell_m, (y0 + dy + 0x1p-32 * cell[2]) * cell_m);
      const double radius_m = std::lerp(boulders.smallest_radius_m, boulders.largest_radius_m, 0x1p-32 * cell[3]);
      const double inside = 1.0 - (place - centre).squaredNorm() / (radius_m * radius_m);
      if (inside > 0.0) highest_m = std::max(highest_m, boulders.height_per_radius * radius_m * std::sqrt(inside));
    }
  }
  return highest_m;
}

double SyntheticSeabed::relief_m(const Vec2& place) const {
  const Relief& relief = parameters_.relief;
  if (relief.rms_m == 0.0) return 0.0;
  double sum = 0.0, mean_square = 0.0;
  double amplitude = 1.0, wavelength_m = relief.longest_wavelength_m;
  for (int octave = 0; octave < relief.octaves; ++octave) {
    sum += amplitude * gradient_noise(relief_, place / wavelength_m, static_cast<std::uint64_t>(octave));
    mean_square += amplitude * amplitude * kNoiseMeanSquare;
    amplitude *= std::pow(0.5, relief.hurst);
    wavelength_m *= 0.5;
  }
  return relief.rms_m / std::sqrt(mean_square) * sum;
}

}  // namespace ensonify::terrain
