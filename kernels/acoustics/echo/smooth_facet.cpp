#include "kernels/acoustics/echo/smooth_facet.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace ensonify::echo {
namespace {

using Complex = std::complex<double>;
using frames::Vec3;
using solids::Corners;
using solids::Facet;

/// exp(j phase): parts of a facet share those of their corners.
struct Turn {
  double phase_rad = 0.0, cosine = 1.0, sine = 0.0;
  Turn() = default;
  explicit Turn(double phase) : phase_rad(phase), cosine(std::cos(phase)), sine(std::sin(phase)) {}
};

Complex times(const Turn& turn, const Complex& by) {
  return {turn.cosine * by.real() - turn.sine * by.imag(), turn.cosine * by.imag() + turn.sine * by.real()};
}

/// (exp(j b) - exp(j a)) / (j (b - a)): near each other as a series, whose neglected terms are below 1e-12.
Complex difference(const Turn& a, const Turn& b) {
  const double d = b.phase_rad - a.phase_rad, d2 = d * d;
  if (d2 > 0.25) return {(b.sine - a.sine) / d, (a.cosine - b.cosine) / d};
  return times(a, {1.0 - d2 / 6.0 * (1.0 - d2 / 20.0 * (1.0 - d2 / 42.0 * (1.0 - d2 / 72.0))),
                   0.5 * d * (1.0 - d2 / 12.0 * (1.0 - d2 / 30.0 * (1.0 - d2 / 56.0)))});
}

/// Twice the second divided difference of exp(j x) at three phases: the mean of exp(j x) over a triangle on which x is
/// linear and has these values at the corners.
Complex mean_of_phases(const Turn& first, const Turn& second, const Turn& third) {
  // The two that are farthest apart come first and last.
  const Turn *a = &first, *b = &second, *c = &third;
  const auto apart = [](const Turn* p, const Turn* q) { return std::abs(p->phase_rad - q->phase_rad); };
  if (apart(b, a) > apart(c, a) && apart(b, a) >= apart(c, b)) std::swap(b, c);
  else if (apart(c, b) > apart(c, a)) std::swap(a, b);
  const double most = c->phase_rad - a->phase_rad;
  if (std::abs(most) > 1.0) {
    const Complex rise = difference(*b, *c) - difference(*a, *b);
    return {2.0 * rise.imag() / most, -2.0 * rise.real() / most};
  }
  // Sum of j^n 2 h(n) / (n + 2)!, where h(n) is the sum of all products of n of the two differences; neglected: 1e-12.
  const double d = b->phase_rad - a->phase_rad, sum = d + most, product = d * most;
  double before = 0.0, h = 1.0, over = 1.0;
  std::array<double, 2> parts{};  // real, imaginary
  for (int n = 0; n < 14; ++n) {
    parts[static_cast<std::size_t>(n % 2)] += (n % 4 < 2 ? over : -over) * h;
    before = std::exchange(h, sum * h - product * before);
    over /= n + 3;
  }
  return times(*a, {parts[0], parts[1]});
}

}  // namespace

Complex phase_integral_m2(const Corners& triangle, const Vec3& per_m) {
  const Vec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
  const double area_m2 = 0.5 * (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm();
  const auto turn = [&](std::size_t corner) { return Turn(per_m.dot(triangle[corner] - middle)); };
  return area_m2 * mean_of_phases(turn(0), turn(1), turn(2));
}

namespace {

/// A corner of a flat part, about the facet's middle.
struct Place {
  Vec3 off_m;
  Turn turn;
  Place() = default;
  Place(const Vec3& off, const Vec3& per_m) : off_m(off), turn(per_m.dot(off)) {}
};

/// Integral of (n . r) exp(j per_m . (x - middle)) over a flat part, as far as it is lit.
Complex lit_integral_m2(const Place& a, const Place& b, const Place& c, const Vec3& towards_head, bool two_sided) {
  double facing_m2 = 0.5 * (b.off_m - a.off_m).cross(c.off_m - a.off_m).dot(towards_head);
  if (two_sided) facing_m2 = std::abs(facing_m2);
  if (!(facing_m2 > 0.0)) return 0.0;
  return facing_m2 * mean_of_phases(a.turn, b.turn, c.turn);
}

/// The same over all of a facet: over as many flat parts as stand for a curved one.
Complex lit_integral_m2(const Facet& facet, const Vec3& towards_head, const Vec3& per_m, bool two_sided) {
  const auto& corner = facet.corners;
  const auto& bulge_m = facet.bulge_m;
  const Vec3 middle = middle_of(facet);
  if (bulge_m == std::array<double, 3>{}) {
    const auto place = [&](std::size_t c) { return Place(corner[c] - middle, per_m); };
    return lit_integral_m2(place(0), place(1), place(2), towards_head, two_sided);
  }
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  constexpr double kStep = 1.0 / kCurvedParts;
  // Row by row: steps towards the second corner; within a row towards the third.
  using Row = std::array<Place, kCurvedParts + 1>;
  const auto row = [&](int i) {
    Row places;
    for (int j = 0; i + j <= kCurvedParts; ++j) {
      const double b = kStep * i, c = kStep * j, a = 1.0 - b - c;
      const double up_m = 4.0 * (bulge_m[0] * a * b + bulge_m[1] * b * c + bulge_m[2] * c * a);
      const Vec3 place = a * corner[0] + b * corner[1] + c * corner[2] + up_m * normal;
      places[static_cast<std::size_t>(j)] = Place(place - middle, per_m);
    }
    return places;
  };
  Complex sum_m2 = 0.0;
  Row here = row(0);
  for (int i = 0; i < kCurvedParts; ++i) {
    const Row next = row(i + 1);
    const auto parts = static_cast<std::size_t>(kCurvedParts - i);
    for (std::size_t j = 0; j < parts; ++j) {
      sum_m2 += lit_integral_m2(here[j], next[j], here[j + 1], towards_head, two_sided);
      if (j + 1 < parts) sum_m2 += lit_integral_m2(next[j], next[j + 1], here[j + 1], towards_head, two_sided);
    }
    here = next;
  }
  return sum_m2;
}

}  // namespace

Complex facet_amplitude_m(const Facet& facet, const Vec3& towards_head, double wavenumber_radpm, bool two_sided) {
  const Vec3 per_m = 2.0 * wavenumber_radpm * towards_head;
  return Complex(0.0, wavenumber_radpm / (2.0 * std::numbers::pi)) *
         lit_integral_m2(facet, towards_head, per_m, two_sided);
}

double longest_side_m(double wavelength_m, double range_m) { return 0.25 * std::sqrt(wavelength_m * range_m); }

}  // namespace ensonify::echo
