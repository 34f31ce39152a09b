#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "kernels/acoustics/array/aperture.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/array/near_field.h"

/// Patterns of transducers as values: products of tables and closed forms, for arrays of directions.
namespace ensonify::array {

inline constexpr float kFarField_m = std::numeric_limits<float>::infinity();

/// Unit vectors in the head's frame, as columns of one length.
struct Directions {
  std::span<const float> x, y, z;

  std::size_t size() const { return x.size(); }
  Eigen::Vector3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  Directions part(std::size_t first, std::size_t count) const {
    return {x.subspan(first, count), y.subspan(first, count), z.subspan(first, count)};
  }
};

// Factors of a pattern: amplitudes with sign, 1 on the axis.

/// A line: the real part of a table, at the direction cosine along an axis less that to which it is steered.
struct LineFactor {
  std::shared_ptr<const PatternTable> table;
  Eigen::Vector3f axis_head = Eigen::Vector3f::UnitX();  // unit
  double sin_steer = 0.0;
  float end = 2.0F;  // from there on, in sine off the axis to either side, it is 0
};

/// A circular piston about the z axis: a table at the sine of the angle from it.
struct PistonFactor {
  std::shared_ptr<const PatternTable> table;
  float end = 2.0F;  // from this sine on it is 0
};

/// A uniform line along x near its source (near_field_line_amplitude): magnitudes.
struct NearFieldFactor {
  enum class Focus { kOff, kFixed, kEcho };
  double length_m = 1.0, wavelength_m = 0.005;
  Focus focus = Focus::kOff;
  double focus_m = kFarAway_m;  // of Focus::kFixed
  bool side_lobes = true;       // without them it ends where the geometric shadow of its ends does, and a null beyond
};

/// A face with this outward normal (Face).
struct FaceFactor {
  Eigen::Vector3f normal_head = Eigen::Vector3f::UnitZ();  // unit
  Face face;
};

/// (1 - y^2)^(power / 2): falls to either side of the plane y = 0.
struct CosineFactor {
  float power = 0.0F;  // of the cosine squared, in the square of the amplitude
};

/// The edge of a sector across y: a table of an edge at sine 0 whose inside lies at positive sines; 1 and 0 beyond
/// `reach` of it.
struct EdgeFactor {
  std::shared_ptr<const PatternTable> table;
  double sine = 0.0;         // of the edge; infinite: none
  bool inside_above = true;  // inside: greater y
  double reach = 0.1;
};

/// exp(-fall (x^2 + y^2)) in front, nothing behind: no side lobes.
struct GaussianFactor {
  double fall = 0.0;
};

/// Pattern of a transducer to or from a point: the product of its factors, 1 everywhere without any. A value: tables
/// are shared by its copies.
///
/// Some factors count as amplitudes, others, whose sign nobody asks for, as powers; an amplitude has the root of those.
class Pattern {
 public:
  using Factor =
      std::variant<LineFactor, PistonFactor, NearFieldFactor, FaceFactor, CosineFactor, EdgeFactor, GaussianFactor>;

  Pattern() = default;

  /// Multiplies by a factor.
  Pattern& times(Factor factor);
  /// Multiplies the power by a factor's.
  Pattern& times_power(Factor factor);
  /// Takes all factors away; memory is kept.
  void clear();

  /// Amplitudes that it gives directions to or from points at these ranges (no ranges: the far field), besides
  /// spreading. Throws std::invalid_argument for spans of different lengths.
  void amplitudes(const Directions& directions, std::span<const float> range_m, std::span<float> amplitude) const;

  /// Their squares, in double.
  void powers(const Directions& directions, std::span<const float> range_m, std::span<double> power) const;

  /// Of one direction.
  float amplitude(const Eigen::Vector3f& direction_head, float range_m = kFarField_m) const;
  double power(const Eigen::Vector3f& direction_head, float range_m = kFarField_m) const;

 private:
  std::vector<Factor> amplitude_factors_, power_factors_;
};

/// Power of transducers that send at once, the sum over them: the fringes between them, finer than any lobe, are
/// averaged.
void powers(std::span<const Pattern> patterns, const Directions& directions, std::span<const float> range_m,
            std::span<double> power);
/// Of one direction.
double power(std::span<const Pattern> patterns, const Eigen::Vector3f& direction_head, float range_m = kFarField_m);

}  // namespace ensonify::array
