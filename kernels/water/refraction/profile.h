#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

/// Refraction of sound in water whose sound speed changes with depth (docs/physics/water/refraction.md).
namespace ensonify::refraction {

/// One sample of a sound speed cast.
struct Knot {
  double depth_m;  // positive down
  double speed_mps;
  bool operator==(const Knot&) const = default;
};

/// Speed of sound over depth: linear between the knots, constant above the first and below the last.
///
/// Depth is positive down from where the cast counts it (the water surface). The water is cut into size() + 1 layers:
/// layer 0 lies above knots[0], layer i between knots i - 1 and i, the last one below the last knot.
class SoundSpeedProfile {
 public:
  static constexpr double kSlowest_mps = 1300.0;  // slower and faster than any water, fresh or salt, to 12 km
  static constexpr double kFastest_mps = 1700.0;

  /// Throws std::invalid_argument, naming the knot, unless there is at least one, depths are finite and rise, and
  /// speeds lie in 1300..1700 m/s.
  explicit SoundSpeedProfile(std::vector<Knot> knots);

  /// The same speed everywhere.
  static SoundSpeedProfile uniform(double speed_mps);

  double speed_mps(double depth_m) const;
  double slowness_spm(double depth_m) const { return 1.0 / speed_mps(depth_m); }

  /// dc/dz in 1/s, positive when speed rises with depth; at a knot that of the layer below it.
  double gradient_per_s(double depth_m) const;

  /// Fewer of the knots (Ramer-Douglas-Peucker), so that the speed differs nowhere by more than tolerance_mps. For
  /// casts with a sample every few decimetres, whose every knot would cost each ray a step.
  SoundSpeedProfile thinned(double tolerance_mps) const;

  std::span<const Knot> knots() const { return knots_; }
  std::size_t layers() const { return knots_.size() + 1; }

  /// The layer that holds a depth; a knot belongs to the layer below it.
  std::size_t layer_at(double depth_m) const;
  double layer_gradient_per_s(std::size_t layer) const { return gradient_per_s_[layer]; }
  /// Edges of a layer; the outer ones reach to infinity.
  double layer_top_m(std::size_t layer) const {
    return layer == 0 ? -std::numeric_limits<double>::infinity() : knots_[layer - 1].depth_m;
  }
  double layer_bottom_m(std::size_t layer) const {
    return layer == knots_.size() ? std::numeric_limits<double>::infinity() : knots_[layer].depth_m;
  }
  /// Speed at a depth within the layer or on its edges.
  double speed_in_layer_mps(std::size_t layer, double depth_m) const {
    if (layer < knots_.size() && depth_m == knots_[layer].depth_m) return knots_[layer].speed_mps;  // both sides agree
    const Knot& knot = knots_[layer == 0 ? 0 : layer - 1];
    return knot.speed_mps + gradient_per_s_[layer] * (depth_m - knot.depth_m);
  }

  bool operator==(const SoundSpeedProfile& other) const { return knots_ == other.knots_; }

 private:
  std::vector<Knot> knots_;
  std::vector<double> gradient_per_s_;  // per layer; 0 in the first and the last
};

}  // namespace ensonify::refraction
