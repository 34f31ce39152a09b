#include "kernels/seabed/relief/bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMostPerCell = 20.0;

/// Range of cells that hold what reaches into [low, high].
std::pair<std::int64_t, std::int64_t> cells_of(double low, double high, double reach, double cell_m) {
  return {static_cast<std::int64_t>(std::floor((low - reach) / cell_m)),
          static_cast<std::int64_t>(std::floor((high + reach) / cell_m))};
}

}  // namespace

Bodies::Bodies(const BodyParameters& parameters, double post_spacing_m, std::uint64_t seed, std::string_view name,
               Field mask)
    : parameters_(parameters), post_spacing_m_(post_spacing_m), noise_(seed, name), mask_(std::move(mask)) {
  const BodyParameters& p = parameters_;
  if (!(p.per_km2 >= 0.0 && p.smallest_radius_m > 0.0 && p.largest_radius_m >= p.smallest_radius_m &&
        p.size_exponent > 0.0 && p.height_per_radius >= 0.0 && p.height_ln_sd >= 0.0 && p.elongation >= 1.0 &&
        p.elongation <= 4.0 && post_spacing_m > 0.0)) {
    throw std::invalid_argument(
        "bodies: allowed are per_km2 >= 0, 0 < smallest_radius_m <= largest_radius_m, size_exponent > 0, "
        "height_per_radius >= 0, height_ln_sd >= 0, elongation 1 to 4");
  }
  reach_m_ = p.largest_radius_m * std::sqrt(p.elongation);
  // Cells of two radii or so, fewer bodies to a cell where there are many, larger cells where there are few.
  const double per_m2 = p.per_km2 * 1e-6;
  double cell_m = 2.0 * p.largest_radius_m;
  if (per_m2 > 0.0) cell_m = std::min(std::max(cell_m, std::sqrt(0.5 / per_m2)), std::sqrt(kMostPerCell / per_m2));
  cell_level_ = std::clamp(static_cast<int>(std::floor(std::log2(cell_m / post_spacing_m))), 0, 30);
  const double side_m = node_spacing_m(post_spacing_m, cell_level_);
  per_cell_ = per_m2 * side_m * side_m;
  if (per_cell_ > 100.0) throw std::invalid_argument("bodies: more than 100 per post; take fewer, or a finer lattice");
}

void Bodies::add_cell(std::int64_t east, std::int64_t north, float mask, std::vector<Body>& bodies) const {
  const auto x = static_cast<std::uint64_t>(east), y = static_cast<std::uint64_t>(north);
  const double side_m = node_spacing_m(post_spacing_m_, cell_level_);
  const int count = random::poisson(per_cell_, noise_.uniform(x, y, 0));
  const BodyParameters& p = parameters_;
  for (int n = 0; n < count; ++n) {
    const auto first = static_cast<std::uint64_t>(4 * n + 1);
    const auto place = noise_.bits(x, y, first), size = noise_.bits(x, y, first + 1);
    if (static_cast<float>(place[2]) * 0x1p-32F >= mask) continue;
    // N(> r) = r^-a between the smallest and the largest, by inversion.
    const double share = std::pow(p.smallest_radius_m / p.largest_radius_m, p.size_exponent);
    const double u = share + (1.0 - share) * (size[0] + 0.5) * 0x1p-32;
    Body body;
    body.centre_enu_m = {(static_cast<double>(east) + place[0] * 0x1p-32) * side_m,
                         (static_cast<double>(north) + place[1] * 0x1p-32) * side_m};
    body.radius_m = p.smallest_radius_m * std::pow(u, -1.0 / p.size_exponent);
    const double spread =
        std::exp(p.height_ln_sd * noise_.normal(x, y, first + 2) - 0.5 * p.height_ln_sd * p.height_ln_sd);
    body.height_m = p.height_per_radius * body.radius_m * spread * (p.shape == BodyShape::kPockmark ? -1.0 : 1.0);
    body.elongation = 1.0 + (p.elongation - 1.0) * size[1] * 0x1p-32;
    const double heading_rad = kPi * size[2] * 0x1p-32;
    body.longer_axis_enu = {std::sin(heading_rad), std::cos(heading_rad)};
    bodies.push_back(body);
  }
}

std::vector<Body> Bodies::within(const frames::Vec2& south_west_enu_m, const frames::Vec2& north_east_enu_m) const {
  std::vector<Body> bodies;
  if (per_cell_ == 0.0) return bodies;
  const double side_m = node_spacing_m(post_spacing_m_, cell_level_);
  const auto [west, east] = cells_of(south_west_enu_m.x(), north_east_enu_m.x(), reach_m_, side_m);
  const auto [south, north] = cells_of(south_west_enu_m.y(), north_east_enu_m.y(), reach_m_, side_m);
  const Window cells{cell_level_, west, south, static_cast<int>(east - west + 1), static_cast<int>(north - south + 1)};
  std::vector<float> mask(cells.size(), 1.0F);
  if (mask_) mask_(cells, mask);
  for (int j = 0; j < cells.rows; ++j) {
    for (int i = 0; i < cells.columns; ++i) add_cell(west + i, south + j, mask[cells.node(i, j)], bodies);
  }
  std::erase_if(bodies, [&](const Body& body) {
    const double r = body.radius_m * std::sqrt(body.elongation);
    return body.centre_enu_m.x() + r < south_west_enu_m.x() || body.centre_enu_m.x() - r > north_east_enu_m.x() ||
           body.centre_enu_m.y() + r < south_west_enu_m.y() || body.centre_enu_m.y() - r > north_east_enu_m.y();
  });
  return bodies;
}

void Bodies::fill(const Window& window, std::span<float> height_m) const {
  std::fill(height_m.begin(), height_m.end(), 0.0F);
  const frames::Vec2 first = place_enu_m(window, 0, 0, post_spacing_m_),
                     last = place_enu_m(window, window.columns - 1, window.rows - 1, post_spacing_m_);
  const double step_m = node_spacing_m(post_spacing_m_, window.level);
  if (window.level > 0 && parameters_.largest_radius_m < step_m) return;
  for (const Body& body : within(first, last)) {
    if (window.level > 0 && body.radius_m < step_m) continue;
    const double reach_m = body.radius_m * std::sqrt(body.elongation);
    const auto clamp_to = [&](double place, double origin, int count) {
      return static_cast<int>(std::clamp((place - origin) / step_m, 0.0, static_cast<double>(count - 1)));
    };
    const int west = clamp_to(body.centre_enu_m.x() - reach_m, first.x(), window.columns),
              east = std::min(clamp_to(body.centre_enu_m.x() + reach_m, first.x(), window.columns) + 1,
                              window.columns - 1),
              south = clamp_to(body.centre_enu_m.y() - reach_m, first.y(), window.rows),
              north = std::min(clamp_to(body.centre_enu_m.y() + reach_m, first.y(), window.rows) + 1, window.rows - 1);
    for (int j = south; j <= north; ++j) {
      for (int i = west; i <= east; ++i) {
        const auto z =
            static_cast<float>(height_at_m(body, parameters_.shape, place_enu_m(window, i, j, post_spacing_m_)));
        float& seen = height_m[window.node(i, j)];
        if (std::abs(z) > std::abs(seen)) seen = z;
      }
    }
  }
}

double height_at_m(const Body& body, BodyShape shape, const frames::Vec2& place_enu_m) {
  const frames::Vec2 offset = place_enu_m - body.centre_enu_m;
  const double along = offset.dot(body.longer_axis_enu);
  const double across = offset.x() * body.longer_axis_enu.y() - offset.y() * body.longer_axis_enu.x();
  const double stretch = body.elongation, r2 = body.radius_m * body.radius_m;
  const double inside = 1.0 - (along * along / stretch + across * across * stretch) / r2;
  if (!(inside > 0.0)) return 0.0;
  return body.height_m * (shape == BodyShape::kBoulder ? std::sqrt(inside) : inside * inside);
}

}  // namespace ensonify::relief
