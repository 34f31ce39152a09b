#include "kernels/survey/uncertainty/sounding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace ensonify::uncertainty {
namespace {

double square(double x) { return x * x; }

/// What an error of standard deviation `sd` in this direction (m per unit) adds.
Matrix3 along(const Vec3& effect, double sd) { return square(sd) * effect * effect.transpose(); }

/// Small turns about east, north, up move a point by turn x point = -[point] turn.
Matrix3 turned(const Vec3& point_m, const Matrix3& rotation_rad2) {
  Matrix3 cross;
  cross << 0, point_m.z(), -point_m.y(), -point_m.z(), 0, point_m.x(), point_m.y(), -point_m.x(), 0;
  return cross * rotation_rad2 * cross.transpose();
}

double tangent(double sine) {
  static const double kSteepest = std::sin(kSteepest_rad);
  const double s = std::clamp(sine, -kSteepest, kSteepest);
  return s / std::sqrt(1.0 - s * s);
}

/// Quantile 0.95 of chi squared with 1 to 2 degrees of freedom: through those of 1, 1.5 and 2, a parabola.
double chi2_95(double freedom) {
  constexpr double k1 = 3.8415, k15 = 4.9802, k2 = 5.9915;
  const double x = 2.0 * (std::clamp(freedom, 1.0, 2.0) - 1.0);
  return k1 + x * (k15 - k1) + 0.5 * x * (x - 1.0) * (k2 - 2.0 * k15 + k1);
}

constexpr std::array kFourth{1.0, -4.0, 6.0, -4.0, 1.0};  // difference: weights of heights a footprint apart
constexpr int kReach = 2;                                 // footprints to either side
constexpr int kPerWidth = 16, kHalfWindow = 12;           // places of a footprint: 1.5 half-power widths

struct Height {
  double height_m, noise_m2;
};

/// Of the rising points `order` of the profile, at a place; empty outside.
std::optional<Height> height_at(std::span<const ProfilePoint> profile, const std::vector<std::size_t>& order,
                                double across_m) {
  const auto after = std::ranges::lower_bound(order, across_m, {}, [&](std::size_t i) { return profile[i].across_m; });
  if (after == order.end() || (after == order.begin() && across_m < profile[*after].across_m)) return std::nullopt;
  const ProfilePoint& b = profile[*after];
  if (after == order.begin()) return Height{b.height_m, b.noise_sd_m * b.noise_sd_m};
  const ProfilePoint& a = profile[*std::prev(after)];
  const double share = (across_m - a.across_m) / (b.across_m - a.across_m);
  return Height{a.height_m + share * (b.height_m - a.height_m),
                std::pow((1.0 - share) * a.noise_sd_m, 2) + std::pow(share * b.noise_sd_m, 2)};
}

/// Of a beam's power, sum 1.
std::vector<double> window() {
  constexpr double kHalfPower = 0.8859;  // of sinc^2: its width
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -kHalfWindow; i <= kHalfWindow; ++i) {
    const double x = std::numbers::pi * kHalfPower * i / kPerWidth;
    sum += weights.emplace_back(i == 0 ? 1.0 : std::pow(std::sin(x) / x, 2));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// Sums of products of weights so many places apart, either way.
std::vector<double> by_distance(const std::vector<double>& weights) {
  std::vector<double> sums(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) sums[i - j] += (i == j ? 1.0 : 2.0) * weights[i] * weights[j];
  }
  return sums;
}

/// Places and widths between neighbours in a footprint, across and along.
double distance_power(std::size_t across, std::size_t along, double aspect, double hurst) {
  const double x = static_cast<double>(across) / kPerWidth, y = aspect * static_cast<double>(along) / kPerWidth;
  return std::pow(x * x + y * y, hurst);
}

/// Sum over all pairs of places: of differences' variance times both weights.
double pairs(const std::vector<double>& across, const std::vector<double>& along, double aspect, double hurst) {
  double sum = 0.0;
  for (std::size_t i = 0; i < across.size(); ++i) {
    for (std::size_t j = 0; j < along.size(); ++j) {
      sum += across[i] * along[j] * distance_power(i, j, aspect, hurst);
    }
  }
  return sum;
}

}  // namespace

Matrix3 covariance_enu_m2(const Geometry& g, const Detected& detected, const Navigation& navigation, const Sources& s) {
  const Vec3& away = g.away_enu_m;
  const double range_m = away.norm();
  const Vec3 ray = away / range_m;
  const auto axes = g.enu_from_head.toRotationMatrix();  // forward, starboard, down of the head
  const Vec3 forward = axes.col(0), starboard = axes.col(1);
  const Vec3 up = Vec3::UnitZ();

  // Angles from the vertical and off the array's normal, and where the sounding goes when they grow.
  const double sin_vertical = std::hypot(ray.x(), ray.y());
  const Vec3 level = sin_vertical > 0.0 ? Vec3(ray.x(), ray.y(), 0.0) / sin_vertical : Vec3(Vec3::Zero());
  const Vec3 outward = range_m * (-ray.z() * level + sin_vertical * up);
  const Vec3 across = away.cross(forward);  // a turn about the forward axis, to starboard
  const double tan_vertical = tangent(sin_vertical), tan_array = tangent(ray.dot(starboard));

  // Sonar: an echo from off the beam's axis moves along the seabed; on the axis that is an error of the range.
  const double sonar_m = std::hypot(detected.range_sd_m, range_m * tan_vertical * detected.angle_sd_rad);
  Matrix3 sum = along(ray, sonar_m) + along(range_m * forward, s.along_rad);

  // The seabed inside the footprint: its mean is received on the beam's axis, too early or too late.
  sum += along(tan_vertical * level - up, detected.relief_sd_m);

  // Navigation.
  sum += navigation.position_enu_m2 + turned(g.lever_enu_m + away, navigation.rotation_enu_rad2);
  sum(2, 2) += square(s.heave_m) + square(s.draught_m) + square(s.squat_m) + square(s.tide_m);
  sum += along(Vec3(g.velocity_enu_mps.x(), g.velocity_enu_mps.y(), 0.0), s.position_latency_s);
  sum += along(Vec3(0.0, 0.0, g.velocity_enu_mps.z()) + g.rate_enu_radps.cross(g.lever_enu_m + away),
               s.attitude_latency_s);

  // Installation.
  for (std::size_t k = 0; k < 3; ++k) sum += along(axes.col(static_cast<Eigen::Index>(k)), s.lever_arm_m[k]);
  sum += along(forward.cross(away), s.roll_rad) + along(starboard.cross(away), s.pitch_rad) +
         along(axes.col(2).cross(away), s.yaw_rad);

  // Sound speed.
  sum += along((away + tan_vertical * outward) / g.sound_speed_mps, s.cast_mps);
  sum += along((tan_array * across - tan_vertical * outward) / g.sound_speed_mps, s.face_mps);
  return sum;
}

double tvu_m(const Matrix3& covariance_enu_m2) { return 1.959964 * std::sqrt(covariance_enu_m2(2, 2)); }

double thu_m(const Matrix3& covariance_enu_m2) {
  const double east = covariance_enu_m2(0, 0), north = covariance_enu_m2(1, 1), both = covariance_enu_m2(0, 1);
  const double mean = east + north;  // of the squared distance
  if (!(mean > 0.0)) return 0.0;
  const double squares = east * east + north * north + 2.0 * both * both;  // half its variance
  return std::sqrt(squares / mean * chi2_95(mean * mean / squares));
}

std::vector<double> squared_bends_m2(std::span<const ProfilePoint> profile) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr Height kUnknown{kNan, kNan};
  std::vector<double> bends(profile.size(), kNan);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (order.empty() || profile[i].across_m > profile[order.back()].across_m) order.push_back(i);
  }
  for (const std::size_t i : order) {
    const ProfilePoint& p = profile[i];
    double bend_m = 0.0, noise_m2 = 0.0;
    for (std::size_t k = 0; k < kFourth.size(); ++k) {
      const double weight = kFourth[k], steps = static_cast<double>(k) - kReach;
      const auto there = height_at(profile, order, p.across_m + steps * p.footprint_m).value_or(kUnknown);
      bend_m += weight * there.height_m;
      noise_m2 += weight * weight * there.noise_m2;
    }
    bends[i] = bend_m * bend_m - noise_m2;
  }
  return bends;
}

double unresolved_share(double hurst, double aspect) {
  // Variance of a sum of heights with weights that add up to 0: -1/2 sum_ij a_i a_j D(|x_i - x_j|), D the variance of
  // differences. Weights are products of one across and one along the track, and so are their sums by distance.
  const std::vector<double> beam = window(), along = by_distance(beam);
  std::vector<double> difference(static_cast<std::size_t>(2 * (kReach * kPerWidth + kHalfWindow) + 1));
  for (std::size_t mean = 0; mean < kFourth.size(); ++mean) {
    for (std::size_t i = 0; i < beam.size(); ++i) difference[mean * kPerWidth + i] += kFourth[mean] * beam[i];
  }
  double to_middle = 0.0;
  for (std::size_t i = 0; i < beam.size(); ++i) {
    for (std::size_t j = 0; j < beam.size(); ++j) {
      const auto off = [](std::size_t k) { return k > kHalfWindow ? k - kHalfWindow : kHalfWindow - k; };
      to_middle += beam[i] * beam[j] * distance_power(off(i), off(j), aspect, hurst);
    }
  }
  const double unresolved = to_middle - 0.5 * pairs(along, along, aspect, hurst);
  return unresolved / (-0.5 * pairs(by_distance(difference), along, aspect, hurst));
}

}  // namespace ensonify::uncertainty
