#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "kernels/acoustics/trace/ray_distribution.h"

/// Rays to places of their own: on small pieces of tiles, and on bodies. Private to this folder.
namespace ensonify::trace {

inline constexpr double kWidest = 0.5;              // of what rays go to, from its middle, over its distance
inline constexpr double kMostRefraction_rad = 0.3;  // to search for it where straight rays would see it

/// Launch directions towards the places of one object.
class Towards {
 public:
  /// Empty where no path, or no single one, goes to its corners.
  static std::optional<Towards> make(const FacetView& view, const Eigen::AlignedBox3d& box_enu_m) {
    constexpr double kSpread_rad = 0.02;  // of what bending does to the directions of one object
    Towards towards(view.head);
    if (view.refracted == nullptr) return towards;
    const frames::Vec3 &head = view.head.position_enu_m, middle = box_enu_m.center();
    const double half_m = 0.5 * box_enu_m.sizes().head<2>().norm();
    const double off_m = (middle - head).head<2>().norm();
    towards.near_m_ = std::max(0.0, off_m - half_m), towards.wide_m_ = off_m + half_m - towards.near_m_;
    towards.top_m_ = head.z() - box_enu_m.max().z(), towards.tall_m_ = std::max(1e-3, box_enu_m.sizes().z());
    double least = 1.0, most = -1.0;
    for (std::size_t c = 0; c < 4; ++c) {
      const double across_m = towards.near_m_ + (c % 2 == 1 ? towards.wide_m_ : 0.0);
      const double below_m = towards.top_m_ + (c >= 2 ? towards.tall_m_ : 0.0);
      const double from_m = view.refracted->source_depth_m();
      const auto path = refraction::eigenray(view.refracted->profile(), from_m, across_m, from_m + below_m);
      if (!path) return std::nullopt;
      towards.turned_rad_[c] = across_m > 0.0 ? path->launch_depression_rad - std::atan2(below_m, across_m) : 0.0;
      least = std::min(least, towards.turned_rad_[c]), most = std::max(most, towards.turned_rad_[c]);
    }
    if (most - least > kSpread_rad) return std::nullopt;
    towards.refracted_ = true;
    return towards;
  }

  /// Direction times distance, head frame.
  frames::Vec3 operator()(const frames::Vec3& place_enu_m) const {
    frames::Vec3 off = place_enu_m - head_enu_m_;
    const double across_m = off.head<2>().norm();
    if (refracted_ && across_m > 0.0) {
      const double a = (across_m - near_m_) / wide_m_, b = (-off.z() - top_m_) / tall_m_;
      const double turned_rad =
          std::lerp(std::lerp(turned_rad_[0], turned_rad_[1], a), std::lerp(turned_rad_[2], turned_rad_[3], a), b);
      const double depression_rad = std::atan2(-off.z(), across_m) + turned_rad, away_m = off.norm();
      const frames::Vec2 outwards = off.head<2>() / across_m;
      off << away_m * std::cos(depression_rad) * outwards, -away_m * std::sin(depression_rad);
    }
    return head_from_enu_ * off;
  }

 private:
  explicit Towards(const frames::HeadPose& head)
      : head_enu_m_(head.position_enu_m), head_from_enu_(head.enu_from_head.toRotationMatrix().transpose()) {}

  frames::Vec3 head_enu_m_;
  Eigen::Matrix3d head_from_enu_;
  bool refracted_ = false;
  double near_m_ = 0.0, wide_m_ = 1.0, top_m_ = 0.0, tall_m_ = 1.0;  // distances and depths below the head
  std::array<double, 4> turned_rad_{};  // by bending: near and far at the top, near and far at the bottom
};

/// A place of a triangle: the k-th of a sequence that fills it evenly [Basu2014]. The digits of k in base 4, the lowest
/// first, say which of the four triangles between the middles of the sides, and again within it. Random digits turn
/// them, so that each place is as likely as any other.
inline frames::Vec3 place_on(const std::array<frames::Vec3, 3>& corners, std::uint32_t turn, std::uint32_t k) {
  constexpr double kWithinFacet = 0.95;  // rays keep off its edges: which of two facets they hit there is rounding
  constexpr std::uint32_t kLevels = 10;  // of its places: a million
  const frames::Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
  const std::array<frames::Vec3, 4> off{corners[0] - centre, corners[1] - centre, corners[2] - centre,
                                        frames::Vec3::Zero()};
  frames::Vec3 place = centre;
  double size = kWithinFacet;
  for (std::uint32_t digits = turn ^ k, level = 0; level < kLevels; ++level, digits >>= 2) {
    const std::uint32_t which = digits & 3U;
    size *= which < 3 ? 0.5 : -0.5;  // the middle one stands on its head
    place += size * off[which];
  }
  return place;
}

}  // namespace ensonify::trace
