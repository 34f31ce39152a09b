#include "kernels/acoustics/echo/smooth_facet.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace ensonify::echo {
namespace {

using Complex = std::complex<double>;
using frames::Vec3;
using solids::Corners;
using solids::Facet;

constexpr double kSmallPhase_rad = 0.1;  // below it a series, above it differences

Complex turned(double phase_rad) { return {std::cos(phase_rad), std::sin(phase_rad)}; }

/// (exp(j a) - exp(j b)) / (j (a - b)).
Complex difference(double a, double b) {
  const double half = 0.5 * (a - b);
  const double sinc = std::abs(half) < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  return sinc * turned(0.5 * (a + b));
}

/// Twice the second divided difference of exp(j x) at three phases whose mean is 0: the mean of exp(j x) over a
/// triangle on which x is linear and has these values at the corners.
Complex mean_of_phases(double a, double b, double c) {
  // The two that are farthest apart come first and last.
  if (std::abs(b - a) > std::abs(c - a) && std::abs(b - a) >= std::abs(c - b)) std::swap(b, c);
  else if (std::abs(c - b) > std::abs(c - a)) std::swap(a, b);
  const double apart = a - c;
  if (std::abs(apart) > kSmallPhase_rad) return 2.0 * (difference(a, b) - difference(b, c)) / Complex(0.0, apart);
  const double p2 = a * a + b * b + c * c, p3 = a * a * a + b * b * b + c * c * c;
  const double p4 = a * a * a * a + b * b * b * b + c * c * c * c;
  return {1.0 - p2 / 24.0 + (p2 * p2 / 8.0 + p4 / 4.0) / 360.0, -p3 / 180.0};
}

}  // namespace

Complex phase_integral_m2(const Corners& triangle, const Vec3& per_m) {
  const Vec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
  const double area_m2 = 0.5 * (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm();
  return area_m2 * mean_of_phases(per_m.dot(triangle[0] - middle), per_m.dot(triangle[1] - middle),
                                  per_m.dot(triangle[2] - middle));
}

namespace {

/// Integral of (n . r) exp(j per_m . (x - middle)) over a flat part, as far as it is lit.
Complex lit_integral_m2(const Corners& part, const Vec3& middle, const Vec3& towards_head, const Vec3& per_m,
                        bool two_sided) {
  double facing_m2 = 0.5 * (part[1] - part[0]).cross(part[2] - part[0]).dot(towards_head);
  if (two_sided) facing_m2 = std::abs(facing_m2);
  if (!(facing_m2 > 0.0)) return 0.0;
  const double p = per_m.dot(part[0] - middle), q = per_m.dot(part[1] - middle), r = per_m.dot(part[2] - middle);
  const double mean = (p + q + r) / 3.0;
  return facing_m2 * turned(mean) * mean_of_phases(p - mean, q - mean, r - mean);
}

/// Calls each(part) for the flat parts of a facet.
template <class Each>
void for_parts(const Facet& facet, const Each& each) {
  const auto& [corner, bulge_m] = facet;
  if (bulge_m == std::array<double, 3>{}) return each(corner);
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  constexpr double kStep = 1.0 / kCurvedParts;
  std::array<std::array<Vec3, kCurvedParts + 1>, kCurvedParts + 1> at;  // steps towards the second and third corner
  for (int i = 0; i <= kCurvedParts; ++i) {
    for (int j = 0; i + j <= kCurvedParts; ++j) {
      const double b = kStep * i, c = kStep * j, a = 1.0 - b - c;
      at[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          a * corner[0] + b * corner[1] + c * corner[2] +
          4.0 * (bulge_m[0] * a * b + bulge_m[1] * b * c + bulge_m[2] * c * a) * normal;
    }
  }
  for (std::size_t i = 0; i < kCurvedParts; ++i) {
    for (std::size_t j = 0; i + j < kCurvedParts; ++j) {
      each(Corners{at[i][j], at[i + 1][j], at[i][j + 1]});
      if (i + j + 1 < kCurvedParts) each(Corners{at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]});
    }
  }
}

}  // namespace

Complex facet_amplitude_m(const Facet& facet, const Vec3& towards_head, double wavenumber_radpm, bool two_sided) {
  const Corners& corner = facet.corners;
  const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0, per_m = 2.0 * wavenumber_radpm * towards_head;
  Complex sum_m2 = 0.0;
  for_parts(facet,
            [&](const Corners& part) { sum_m2 += lit_integral_m2(part, middle, towards_head, per_m, two_sided); });
  return Complex(0.0, wavenumber_radpm / (2.0 * std::numbers::pi)) * sum_m2;
}

double longest_side_m(double wavelength_m, double range_m) { return 0.25 * std::sqrt(wavelength_m * range_m); }

}  // namespace ensonify::echo
