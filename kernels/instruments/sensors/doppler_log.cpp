#include "kernels/instruments/sensors/doppler_log.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::sensors {
namespace {

enum Lane : std::uint64_t { kScale = 0, kBottom = 1, kDropout = 5, kWater = 9, kBins = 16 };

}  // namespace

std::array<frames::Vec3, 4> JanusGeometry::directions() const {
  std::array<frames::Vec3, 4> directions;
  for (std::size_t beam = 0; beam < 4; ++beam) {
    const double azimuth = first_azimuth_rad + static_cast<double>(beam) * std::numbers::pi / 2.0;
    directions[beam] = {std::sin(slant_rad) * std::cos(azimuth), std::sin(slant_rad) * std::sin(azimuth),
                        std::cos(slant_rad)};
  }
  return directions;
}

DopplerLog::DopplerLog(const JanusGeometry& geometry, const DopplerErrors& errors, const random::Stream& stream)
    : directions_(geometry.directions()), errors_(errors), stream_(stream) {}

DopplerReading DopplerLog::solve(const frames::Vec3& velocity_mps, const std::array<bool, 4>& lock, std::uint64_t n,
                                 std::uint64_t lane) const {
  // Each beam sees what the transducer moves along it; velocity follows by weighted least squares over locked beams.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  frames::Vec3 right = frames::Vec3::Zero();
  const double scale = 1.0 + errors_.scale * stream_.normal(0, kScale);
  std::array<double, 4> radial{};
  int locked = 0;
  for (std::size_t beam = 0; beam < 4; ++beam) {
    if (!lock[beam]) continue;
    ++locked;
    const double true_mps = directions_[beam].dot(velocity_mps);
    const double sigma = std::hypot(errors_.beam_white_mps, errors_.beam_white_share * true_mps);
    radial[beam] = scale * true_mps + sigma * stream_.normal(n, lane + beam);
    const double weight = 1.0 / std::max(sigma * sigma, 1e-12);
    information += weight * directions_[beam] * directions_[beam].transpose();
    right += weight * radial[beam] * directions_[beam];
  }
  DopplerReading reading;
  if (locked < 3) return reading;
  reading.valid = true;
  const Eigen::Matrix3d covariance = information.inverse();
  reading.velocity_mps = covariance * right;
  reading.sigma_mps = covariance.diagonal().cwiseSqrt();
  if (locked == 4) {  // opposite beams see the same vertical velocity
    reading.error_velocity_mps = 0.25 * (radial[0] - radial[1] + radial[2] - radial[3]) / directions_[0].z();
  }
  return reading;
}

DopplerReading DopplerLog::bottom_track(const frames::Vec3& velocity_mps,
                                        const std::array<std::optional<double>, 4>& range_m, std::uint64_t n) const {
  std::array<bool, 4> lock{};
  double down = 0.0;
  int locked = 0;
  for (std::size_t beam = 0; beam < 4; ++beam) {
    lock[beam] = range_m[beam] && *range_m[beam] >= errors_.shortest_m && *range_m[beam] <= errors_.longest_m &&
                 stream_.uniform(n, kDropout + beam) >= errors_.dropout;
    if (!lock[beam]) continue;
    down += *range_m[beam] * directions_[beam].z();
    ++locked;
  }
  DopplerReading reading = solve(velocity_mps, lock, n, kBottom);
  for (std::size_t beam = 0; beam < 4; ++beam) {
    if (lock[beam]) reading.range_m[beam] = range_m[beam];
  }
  if (locked > 0) reading.altitude_m = down / locked;
  return reading;
}

DopplerReading DopplerLog::water_track(const frames::Vec3& relative_mps, std::uint64_t n) const {
  return solve(relative_mps, {true, true, true, true}, n, kWater);
}

std::vector<BinReading> profile_current(const JanusGeometry& geometry, const DopplerErrors& errors,
                                        const BinLayout& layout, const std::vector<frames::Vec3>& relative_mps,
                                        std::optional<double> altitude_m, const random::Stream& stream,
                                        std::uint64_t n) {
  const double reach_m = std::min(errors.longest_m * std::cos(geometry.slant_rad),
                                  altitude_m ? *altitude_m * std::cos(geometry.slant_rad) : errors.longest_m);
  // Pairs of beams give horizontal components: noise of a beam times 1 / (sqrt 2 sin slant) [Gordon1996].
  const double sigma_mps = errors.beam_white_mps / (std::numbers::sqrt2 * std::sin(geometry.slant_rad));
  const double sigma_down_mps = errors.beam_white_mps / (2.0 * std::cos(geometry.slant_rad));
  const double scale = 1.0 + errors.scale * stream.normal(0, kScale);
  std::vector<BinReading> bins;
  for (int i = 0; i < layout.count && static_cast<std::size_t>(i) < relative_mps.size(); ++i) {
    if (layout.middle_m(i) + 0.5 * layout.thickness_m > reach_m) break;
    const auto lane = kBins + 3 * static_cast<std::uint64_t>(i);
    const frames::Vec3 noise(sigma_mps * stream.normal(n, lane), sigma_mps * stream.normal(n, lane + 1),
                             sigma_down_mps * stream.normal(n, lane + 2));
    bins.push_back({layout.middle_m(i), scale * relative_mps[static_cast<std::size_t>(i)] + noise, sigma_mps});
  }
  return bins;
}

}  // namespace ensonify::sensors
