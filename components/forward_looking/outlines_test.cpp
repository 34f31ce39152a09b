// Masks of a forward-looking head against rays that are intersected with solids in closed form.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "components/forward_looking/head.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"
#include "components/terrain/object_message.h"

using namespace ensonify;
using frames::Vec3;

namespace {

constexpr double kSpeed_mps = 1500.0;
const Vec3 kHead(0.0, 0.0, -10.0);
constexpr double kReach_m = 2.0;  // of a body from its middle

/// Distance along a ray from a point outside a convex solid to where it enters, in the solid's own axes.
using Entry = std::function<std::optional<double>(const Vec3& from, const Vec3& along)>;

/// The part of a ray, as distances, that lies within something.
struct Within {
  double from = -1e9, to = 1e9;

  void meet(double a, double b) { from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b)); }
  void slab(double at, double along, double low, double high) {
    if (along != 0.0) return meet((low - at) / along, (high - at) / along);
    if (at < low || at > high) to = -2e9;
  }
  /// Where a t^2 + 2 b t + c <= 0, for a > 0.
  void quadric(double a, double b, double c) {
    const double root = b * b - a * c;
    if (root < 0.0) to = -2e9;
    else meet((-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a);
  }
  std::optional<double> entry() const { return from < to && from > 0.0 ? std::optional(from) : std::nullopt; }
};

Entry entry_of(const solids::Sphere& sphere) {
  return [r = 0.5 * sphere.diameter_m](const Vec3& p, const Vec3& d) {
    Within within;
    within.quadric(d.dot(d), p.dot(d), p.dot(p) - r * r);
    return within.entry();
  };
}

Entry entry_of(const solids::Box& box) {
  return [half = Vec3(0.5 * box.size_m)](const Vec3& p, const Vec3& d) {
    Within within;
    for (int i = 0; i < 3; ++i) within.slab(p[i], d[i], -half[i], half[i]);
    return within.entry();
  };
}

Entry entry_of(const solids::Cylinder& cylinder) {
  return [r = 0.5 * cylinder.diameter_m, half = 0.5 * cylinder.length_m](const Vec3& p, const Vec3& d) {
    Within within;
    within.slab(p.y(), d.y(), -half, half);
    within.quadric(d.x() * d.x() + d.z() * d.z(), p.x() * d.x() + p.z() * d.z(), p.x() * p.x() + p.z() * p.z() - r * r);
    return within.entry();
  };
}

/// Its radius falls by `slope` for each metre up. Rays steeper than its side are not needed here.
Entry entry_of(const solids::Cone& cone) {
  const double half = 0.5 * cone.height_m, slope = 0.5 * (cone.diameter_m - cone.top_diameter_m) / cone.height_m;
  return [half, slope, middle = 0.25 * (cone.diameter_m + cone.top_diameter_m)](const Vec3& p, const Vec3& d) {
    Within within;
    within.slab(p.z(), d.z(), -half, half);
    const double radius = middle - slope * p.z(), shrinks = slope * d.z();
    within.quadric(d.x() * d.x() + d.y() * d.y() - shrinks * shrinks, p.x() * d.x() + p.y() * d.y() + radius * shrinks,
                   p.x() * p.x() + p.y() * p.y() - radius * radius);
    return within.entry();
  };
}

struct Body {
  solids::Solid solid;
  Entry entry;
  Vec3 from_head_m;
  frames::Quaternion enu_from_object = frames::Quaternion::Identity();

  std::optional<double> hit(const Vec3& along) const {
    const frames::Quaternion back = enu_from_object.conjugate();
    return entry(back * Vec3(-from_head_m), back * along);
  }
};

template <class Solid>
Body body(const Solid& solid, const Vec3& from_head_m, double heading_rad = 0.0, double tilt_rad = 0.0) {
  const frames::Quaternion turn(Eigen::AngleAxisd(-heading_rad, Vec3::UnitZ()) *
                                Eigen::AngleAxisd(tilt_rad, Vec3::UnitX()));
  return {solid, entry_of(solid), from_head_m, turn};
}

using Cells = std::set<std::pair<int, int>>;  // beam, sample
/// Whether the seabed stands before so far a place.
using Ground = std::function<bool(const Vec3& along, double to_m)>;

ForwardLookingConfig plain() {
  ForwardLookingConfig config;
  world_of(config).water.profile.sound_speed_mps = kSpeed_mps;
  world_of(config).seabed.sediments = {{0, seabed::Lambert{-25.0}}, {1, seabed::Lambert{-10.0}}};
  config.process = "eye";
  config.range_m = 20.0;
  config.labels = LabelKind::kMasks;
  config.effects.multipath = false;
  return config;
}

/// Cells that the first body covers for more than a tenth of their width, where nothing is in front of it.
Cells cells_of(const msg::Ping& ping, std::span<const Body> bodies, const Ground& ground) {
  constexpr int kAcross = 50, kAlong = 1500;  // of a beam; of elevations
  constexpr double kLowest_rad = -0.35, kStep_rad = 0.7 / kAlong, kOneSurface_m = 0.3;
  const auto beam = [&](std::size_t b) { return std::sin(static_cast<double>(ping.beam_angle_rad[b])); };
  const auto sample = [&](double range_m) {
    return static_cast<int>(std::floor(2.0 * range_m / kSpeed_mps / ping.sample_period_s + 0.5));
  };
  Cells cells;
  for (std::size_t b = 1; b + 1 < ping.beam_angle_rad.size(); ++b) {
    const double lower = 0.5 * (beam(b - 1) + beam(b)), upper = 0.5 * (beam(b) + beam(b + 1));
    // Beams far from the body have none of it.
    const Vec3& middle = bodies.front().from_head_m;
    if (std::abs(beam(b) - middle.x() / middle.norm()) > kReach_m / middle.norm()) continue;
    std::map<int, int> covered;
    for (int i = 0; i < kAcross; ++i) {
      const double sine = std::lerp(lower, upper, (i + 0.5) / kAcross), across = std::sqrt(1.0 - sine * sine);
      const auto range_m = [&](double down) {
        const Vec3 along(sine, across * std::cos(down), -across * std::sin(down));
        std::optional<double> hit = bodies.front().hit(along);
        for (const Body& other : bodies.subspan(1)) {
          const auto in_front = other.hit(along);
          if (hit && in_front && *in_front < *hit) hit.reset();
        }
        if (hit && ground(along, *hit)) hit.reset();
        return hit;
      };
      std::set<int> samples;
      const auto cover = [&](double one_m, double other_m) {
        for (int k = sample(std::min(one_m, other_m)); k <= sample(std::max(one_m, other_m)); ++k) samples.insert(k);
      };
      std::optional<double> before;
      for (int j = 0; j <= kAlong; ++j) {
        const double down = kLowest_rad + j * kStep_rad;
        const std::optional<double> hit = range_m(down);
        if (hit && before && std::abs(*hit - *before) < kOneSurface_m) cover(*before, *hit);
        if (hit.has_value() != before.has_value() && j > 0) {  // to where it ends
          double seen = hit ? down : down - kStep_rad, unseen = hit ? down - kStep_rad : down;
          for (int halving = 0; halving < 30; ++halving)
            (range_m(0.5 * (seen + unseen)) ? seen : unseen) = 0.5 * (seen + unseen);
          cover(*range_m(seen), hit ? *hit : *before);
        }
        before = hit;
      }
      for (const int k : samples) ++covered[k];
    }
    for (const auto& [k, count] : covered) {
      if (10 * count > kAcross) cells.emplace(static_cast<int>(b), k);
    }
  }
  return cells;
}

Cells mask_of(const msg::Labels& labels, std::int64_t instance) {
  Cells cells;
  for (std::size_t i = 0; i < labels.mask_run.rows(); ++i) {
    if (labels.objects[static_cast<std::size_t>(labels.mask_run(i, 0))].instance != instance) continue;
    for (std::int32_t k = labels.mask_run(i, 2); k < labels.mask_run(i, 3); ++k)
      cells.emplace(labels.mask_run(i, 1), k);
  }
  return cells;
}

/// The first body's mask, and what it should be.
struct Masks {
  Cells made, expected;

  double iou() const {
    std::size_t both = 0;
    for (const auto& cell : made) both += expected.count(cell);
    return static_cast<double>(both) / static_cast<double>(made.size() + expected.size() - both);
  }
};

Masks masks_of(const std::vector<Body>& bodies, const std::function<double(double, double)>& height_m,
               const Ground& ground) {
  const ForwardLookingConfig config = plain();
  TileSet tiles(config.lod, kSpeed_mps / config.frequency_hz);
  tiles.insert(tile_of(64.0, 0.25, height_m));
  std::int64_t number = 0;
  for (const Body& one : bodies) {
    msg::Object object;
    object.number = object.instance = ++number;
    object.name = object.class_name = "body";
    object.class_id = 1;
    put_shape(one.solid, object);
    const Vec3 at = kHead + one.from_head_m;
    object.position_enu_m = {at.x(), at.y(), at.z()};
    object.enu_from_object = {one.enu_from_object.w(), one.enu_from_object.x(), one.enu_from_object.y(),
                              one.enu_from_object.z()};
    object.sediment = 1;
    tiles.insert(object);
  }
  frames::PoseHistory truth{10'000'000'000};
  truth.push(0, {kHead, frames::enu_from_ned()});
  ForwardLooking head(config, 0);
  const auto report =
      report_of(head, {0, SimTime{0}, config.range_m}, config.start(), around(truth, tiles.scene(), kSpeed_mps));
  return {mask_of(std::get<1>(report.messages).value(), 1),
          cells_of(std::get<0>(report.messages).value(), bodies, ground)};
}

double deep(double, double) { return -200.0; }
bool no_ground(const Vec3&, double) { return false; }

std::vector<Body> shapes(const Vec3& at) {
  return {body(solids::Box{{2.2, 1.6, 1.2}}, at, 0.5), body(solids::Cylinder{1.2, 2.4}, at, 1.1, 0.2),
          body(solids::Cone{2.4, 0.8, 1.6}, at, 0.0, 0.15), body(solids::Sphere{2.0}, at)};
}

}  // namespace

TEST_CASE("masks of turned solids in free water are their closed forms") {
  for (const Body& one : shapes({1.0, 9.0, -1.4})) {
    const Masks masks = masks_of({one}, deep, no_ground);
    CAPTURE(one.solid.index(), masks.made.size(), masks.expected.size());
    REQUIRE(masks.expected.size() > 1500);
    // Facets a thousandth of a round body's size off end some samples before its limb, where it is seen flat.
    CHECK(masks.iou() > (std::holds_alternative<solids::Box>(one.solid) ? 0.98 : 0.95));
  }
}

TEST_CASE("masks of solids behind another, over a rough seabed, are their closed forms") {
  const auto height_m = [](double east, double north) {
    return kHead.z() - 2.2 + 0.04 * north + 0.12 * std::sin(2.1 * east) * std::cos(1.7 * north);
  };
  const Ground ground = [&](const Vec3& along, double to_m) {
    for (double t = 3.0; t < to_m; t += 0.05) {
      const Vec3 at = kHead + t * along;
      if (at.z() < height_m(at.x(), at.y())) return true;
    }
    return false;
  };
  const Body in_front = body(solids::Sphere{0.5}, {0.6, 5.0, -0.5});
  for (const Body& one : shapes({1.0, 9.0, -0.9})) {
    const Masks masks = masks_of({one, in_front}, height_m, ground);
    CAPTURE(one.solid.index(), masks.made.size(), masks.expected.size());
    REQUIRE(masks.expected.size() > 1000);
    CHECK(masks.iou() > 0.98);
  }
}
