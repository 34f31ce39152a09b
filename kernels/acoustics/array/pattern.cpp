#include "kernels/acoustics/array/pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "kernels/base/fast_math/fast_math.h"
#include "kernels/base/isa/wide.h"

namespace ensonify::array {
namespace {

constexpr double kNearest_m = 1e-3;  // range from which the near field is reckoned
constexpr std::size_t kRun = 256;    // directions whose numbers stay in the first cache

float amplitude_of(const PistonFactor& piston, const Eigen::Vector3f& direction, float) {
  const float sine = direction.head<2>().norm();
  return sine < piston.end ? piston.table->amplitude(static_cast<double>(sine)).real() : 0.0F;
}

float amplitude_of(const NearFieldFactor& line, const Eigen::Vector3f& direction, float range_m) {
  using Focus = NearFieldFactor::Focus;
  const double u = static_cast<double>(direction.x()), range = std::max(static_cast<double>(range_m), kNearest_m);
  const double focus = line.focus == Focus::kEcho ? range : line.focus == Focus::kFixed ? line.focus_m : kFarAway_m;
  const double shadow = 0.5 * line.length_m * std::abs(1.0 / range - 1.0 / focus);
  if (!line.side_lobes && std::abs(u) > shadow + line.wavelength_m / line.length_m) return 0.0F;
  return static_cast<float>(std::abs(near_field_line_amplitude(line.length_m, line.wavelength_m, u, range, focus)));
}

double face_of(const FaceFactor& face, const Eigen::Vector3f& direction) {
  return face.face.amplitude(static_cast<double>(face.normal_head.dot(direction)));
}

float amplitude_of(const FaceFactor& face, const Eigen::Vector3f& direction, float) {
  return static_cast<float>(face_of(face, direction));
}

/// (1 - y^2)^power, power above 0.
inline float cosine_power(float y, float power) {
  const float squared = (1.0F - y) * (1.0F + y);
  const float value = fast_math::exp2(std::numbers::log2e_v<float> * power * fast_math::log(squared));
  return squared > 0.0F ? value : 0.0F;
}

float power_of(const CosineFactor& cosine, const Eigen::Vector3f& direction) {
  return cosine.power == 0.0F ? 1.0F : cosine_power(direction.y(), cosine.power);
}

float amplitude_of(const CosineFactor& cosine, const Eigen::Vector3f& direction, float) {
  return std::sqrt(power_of(cosine, direction));
}

float amplitude_of(const EdgeFactor& edge, const Eigen::Vector3f& direction, float) {
  const double across = static_cast<double>(direction.y());
  const double inside = edge.inside_above ? across - edge.sine : edge.sine - across;
  if (inside >= edge.reach) return 1.0F;
  return inside > -edge.reach ? edge.table->amplitude(inside).real() : 0.0F;
}

float amplitude_of(const GaussianFactor& gaussian, const Eigen::Vector3f& direction, float) {
  const auto off_axis = static_cast<double>(direction.head<2>().squaredNorm());
  return direction.z() > 0.0F ? static_cast<float>(std::exp(-gaussian.fall * off_axis)) : 0.0F;
}

/// Square of a factor's amplitude; of a table, of all that it holds.
template <class Factor>
double power_factor(const Factor& factor, const Eigen::Vector3f& direction, float range_m) {
  if constexpr (std::is_same_v<Factor, FaceFactor>) {
    const double face = face_of(factor, direction);
    return face * face;
  } else if constexpr (std::is_same_v<Factor, CosineFactor>) {
    return static_cast<double>(power_of(factor, direction));
  } else {
    const auto amplitude = static_cast<double>(amplitude_of(factor, direction, range_m));
    return amplitude * amplitude;
  }
}

void check(const Directions& directions, std::span<const float> range_m, std::size_t out) {
  const std::size_t count = directions.size();
  const bool fits = directions.y.size() == count && directions.z.size() == count && out == count &&
                    (range_m.empty() || range_m.size() == count);
  if (!fits) throw std::invalid_argument("a pattern needs one direction, one range or none, and room for each number");
}

float range_of(std::span<const float> range_m, std::size_t i) { return range_m.empty() ? kFarField_m : range_m[i]; }

template <class T>
using Column = std::array<T, kRun>;

/// Where on a line's table directions lie, kRun at most.
struct OnLine {
  alignas(64) Column<std::int32_t> step, inside;
  alignas(64) Column<float> before, at, after, beyond;

  OnLine(const LineFactor& line, const Directions& directions) { find(line, directions); }

  ENSONIFY_WIDE void find(const LineFactor& line, const Directions& directions) {
    const float ax = line.axis_head.x(), ay = line.axis_head.y(), az = line.axis_head.z();
    const double sin_steer = line.sin_steer, end = static_cast<double>(line.end);
    const PatternTable::Scale scale = line.table->scale();
    const float *const x = directions.x.data(), *const y = directions.y.data(), *const z = directions.z.data();
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double sine = static_cast<double>(ax * x[i] + ay * y[i] + az * z[i]) - sin_steer;
      const PatternTable::Interval in = scale.interval(sine);
      step[i] = in.step;
      before[i] = in.before, at[i] = in.at, after[i] = in.after, beyond[i] = in.beyond;
      inside[i] = std::abs(sine) < end ? 1 : 0;
    }
  }
  std::complex<float> amplitude(const PatternTable& table, std::size_t i) const {
    return inside[i] ? table.amplitude({step[i], before[i], at[i], after[i], beyond[i]}) : std::complex<float>();
  }
};

/// Of a face whose amplitude depends on the side alone: that, for each direction.
void sides(const FaceFactor& face, const Directions& directions, Column<float>& out) {
  const float nx = face.normal_head.x(), ny = face.normal_head.y(), nz = face.normal_head.z();
  const auto behind = static_cast<float>(face.face.behind());
  const float *const x = directions.x.data(), *const y = directions.y.data(), *const z = directions.z.data();
  for (std::size_t i = 0; i < directions.size(); ++i)
    out[i] = nx * x[i] + (ny * y[i] + nz * z[i]) >= 0.0F ? 1.0F : behind;
}

/// Multiplies by one factor's amplitudes, kRun at most.
template <class Factor>
void times(const Factor& factor, const Directions& directions, std::span<const float> range_m,
           std::span<float> amplitude) {
  for (std::size_t i = 0; i < amplitude.size(); ++i)
    amplitude[i] *= amplitude_of(factor, directions[i], range_of(range_m, i));
}

void times(const LineFactor& line, const Directions& directions, std::span<const float>, std::span<float> amplitude) {
  const OnLine on(line, directions);
  for (std::size_t i = 0; i < amplitude.size(); ++i) amplitude[i] *= on.amplitude(*line.table, i).real();
}

void times(const FaceFactor& face, const Directions& directions, std::span<const float> range_m,
           std::span<float> amplitude) {
  if (!face.face.even()) return times<FaceFactor>(face, directions, range_m, amplitude);
  alignas(64) Column<float> one;
  sides(face, directions, one);
  for (std::size_t i = 0; i < amplitude.size(); ++i) amplitude[i] *= one[i];
}

/// The same of powers.
template <class Factor>
void times_power(const Factor& factor, const Directions& directions, std::span<const float> range_m,
                 std::span<double> power) {
  if constexpr (std::is_same_v<Factor, LineFactor>) {
    const OnLine on(factor, directions);
    for (std::size_t i = 0; i < power.size(); ++i) {
      const std::complex<float> a = on.amplitude(*factor.table, i);
      power[i] *= static_cast<double>(a.real() * a.real() + a.imag() * a.imag());
    }
  } else if constexpr (std::is_same_v<Factor, CosineFactor>) {
    const float fall = factor.power;
    if (fall == 0.0F) return;
    const float* const y = directions.y.data();
    for (std::size_t i = 0; i < power.size(); ++i) power[i] *= static_cast<double>(cosine_power(y[i], fall));
  } else {
    for (std::size_t i = 0; i < power.size(); ++i)
      power[i] *= power_factor(factor, directions[i], range_of(range_m, i));
  }
}

/// Multiplies by the factors' amplitudes.
void multiply(std::span<const Pattern::Factor> factors, const Directions& directions, std::span<const float> range_m,
              std::span<float> amplitude) {
  for (const Pattern::Factor& one : factors) {
    std::visit([&](const auto& factor) { times(factor, directions, range_m, amplitude); }, one);
  }
}

void multiply_powers(std::span<const Pattern::Factor> factors, const Directions& directions,
                     std::span<const float> range_m, std::span<double> power) {
  for (const Pattern::Factor& one : factors) {
    std::visit([&](const auto& factor) { times_power(factor, directions, range_m, power); }, one);
  }
}

/// Calls with runs of directions and their ranges.
template <class Work>
void for_runs(const Directions& directions, std::span<const float> range_m, const Work& work) {
  for (std::size_t first = 0; first < directions.size(); first += kRun) {
    const std::size_t count = std::min(kRun, directions.size() - first);
    work(first, count, directions.part(first, count), range_m.empty() ? range_m : range_m.subspan(first, count));
  }
}

}  // namespace

Pattern& Pattern::times(Factor factor) {
  amplitude_factors_.push_back(std::move(factor));
  return *this;
}

Pattern& Pattern::times_power(Factor factor) {
  power_factors_.push_back(std::move(factor));
  return *this;
}

void Pattern::clear() {
  amplitude_factors_.clear();
  power_factors_.clear();
}

void Pattern::amplitudes(const Directions& directions, std::span<const float> range_m,
                         std::span<float> amplitude) const {
  check(directions, range_m, amplitude.size());
  std::ranges::fill(amplitude, 1.0F);
  for_runs(directions, range_m, [&](std::size_t first, std::size_t count, const Directions& of, auto ranges) {
    const auto out = amplitude.subspan(first, count);
    multiply(amplitude_factors_, of, ranges, out);
    if (power_factors_.empty()) return;
    std::array<double, kRun> power;
    std::fill_n(power.begin(), count, 1.0);
    multiply_powers(power_factors_, of, ranges, std::span(power).first(count));
    for (std::size_t i = 0; i < count; ++i) out[i] *= static_cast<float>(std::sqrt(power[i]));
  });
}

void Pattern::powers(const Directions& directions, std::span<const float> range_m, std::span<double> power) const {
  check(directions, range_m, power.size());
  for_runs(directions, range_m, [&](std::size_t first, std::size_t count, const Directions& of, auto ranges) {
    std::array<float, kRun> amplitude;
    std::fill_n(amplitude.begin(), count, 1.0F);
    multiply(amplitude_factors_, of, ranges, std::span(amplitude).first(count));
    const auto out = power.subspan(first, count);
    for (std::size_t i = 0; i < count; ++i)
      out[i] = static_cast<double>(amplitude[i]) * static_cast<double>(amplitude[i]);
    multiply_powers(power_factors_, of, ranges, out);
  });
}

float Pattern::amplitude(const Eigen::Vector3f& d, float range_m) const {
  float amplitude = 1.0F;
  amplitudes({{&d.x(), 1}, {&d.y(), 1}, {&d.z(), 1}}, {&range_m, 1}, {&amplitude, 1});
  return amplitude;
}

double Pattern::power(const Eigen::Vector3f& d, float range_m) const {
  double power = 1.0;
  powers({{&d.x(), 1}, {&d.y(), 1}, {&d.z(), 1}}, {&range_m, 1}, {&power, 1});
  return power;
}

void powers(std::span<const Pattern> patterns, const Directions& directions, std::span<const float> range_m,
            std::span<double> power) {
  check(directions, range_m, power.size());
  std::ranges::fill(power, 0.0);
  for_runs(directions, range_m, [&](std::size_t first, std::size_t count, const Directions& of, auto ranges) {
    std::array<double, kRun> one;
    for (const Pattern& pattern : patterns) {
      pattern.powers(of, ranges, std::span(one).first(count));
      for (std::size_t i = 0; i < count; ++i) power[first + i] += one[i];
    }
  });
}

double power(std::span<const Pattern> patterns, const Eigen::Vector3f& direction_head, float range_m) {
  double sum = 0.0;
  for (const Pattern& pattern : patterns) sum += pattern.power(direction_head, range_m);
  return sum;
}

}  // namespace ensonify::array
