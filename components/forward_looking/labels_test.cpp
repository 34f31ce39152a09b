// Labels of a forward-looking head against what geometry says, for bodies whose outlines are closed forms.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "components/forward_looking/head.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"
#include "components/terrain/object_message.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

constexpr double kSpeed_mps = 1500.0;
const frames::Vec3 kHead(0.0, 0.0, -10.0);

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

msg::Object object_at(const solids::Solid& solid, const frames::Vec3& from_head_m, std::int64_t instance = 1) {
  msg::Object object;
  object.number = instance;
  object.name = "target";
  object.class_name = "mine";
  object.instance = instance;
  object.class_id = 3;
  put_shape(solid, object);
  const frames::Vec3 at = kHead + from_head_m;
  object.position_enu_m = {at.x(), at.y(), at.z()};
  object.sediment = 1;
  return object;
}

/// The head points north and rests, unless a test adds poses.
struct Sea {
  explicit Sea(const ForwardLookingConfig& of, const std::function<double(double, double)>& height_m)
      : config(of), tiles(of.lod, kSpeed_mps / of.frequency_hz) {
    tiles.insert(tile_of(64.0, 0.5, height_m));
    truth.push(0, {kHead, frames::enu_from_ned()});
  }
  explicit Sea(const ForwardLookingConfig& of = plain()) : Sea(of, [](double, double) { return -200.0; }) {}

  ForwardLooking::Report report(std::int64_t number = 0) {
    ForwardLooking head(config, 0);
    return report_of(head, {number, SimTime{0}, config.range_m}, config.start(),
                     around(truth, tiles.scene(), kSpeed_mps));
  }
  msg::Labels labels() { return std::get<1>(report().messages).value(); }

  ForwardLookingConfig config;
  TileSet tiles;
  frames::PoseHistory truth{10'000'000'000};
};

using Cells = std::set<std::pair<int, int>>;  // beam, sample

Cells cells_of(const msg::Array<std::int32_t>& runs, std::int32_t whose) {
  Cells cells;
  for (std::size_t i = 0; i < runs.rows(); ++i) {
    if (runs(i, 0) != whose) continue;
    for (std::int32_t k = runs(i, 2); k < runs(i, 3); ++k) cells.emplace(runs(i, 1), k);
  }
  return cells;
}

double iou(const Cells& a, const Cells& b) {
  std::size_t both = 0;
  for (const auto& cell : a) both += b.count(cell);
  return static_cast<double>(both) / static_cast<double>(a.size() + b.size() - both);
}

/// Samples that the visible side of a sphere straight ahead covers for more than a tenth of a beam's width.
Cells sphere_cells(const msg::Ping& ping, double away_m, double radius_m) {
  constexpr int kSteps = 400;  // of a beam
  Cells cells;
  const auto beam = [&](std::size_t b) { return std::sin(static_cast<double>(ping.beam_angle_rad[b])); };
  const double farthest_m = std::sqrt(away_m * away_m - radius_m * radius_m);
  for (std::size_t b = 1; b + 1 < ping.beam_angle_rad.size(); ++b) {
    const double lower = 0.5 * (beam(b - 1) + beam(b)), upper = 0.5 * (beam(b) + beam(b + 1));
    std::map<int, int> covered;
    for (int i = 0; i < kSteps; ++i) {
      const double sine = std::lerp(lower, upper, (i + 0.5) / kSteps);
      if (std::abs(sine) * away_m >= radius_m) continue;
      const double nearest_m =
          away_m * std::sqrt(1.0 - sine * sine) - std::sqrt(radius_m * radius_m - std::pow(away_m * sine, 2));
      const auto sample = [&](double range_m) {
        return static_cast<int>(std::floor(2.0 * range_m / kSpeed_mps / ping.sample_period_s + 0.5));
      };
      for (int k = sample(nearest_m); k <= sample(farthest_m); ++k) ++covered[k];
    }
    for (const auto& [sample, count] : covered) {
      if (10 * count > kSteps) cells.emplace(static_cast<int>(b), sample);
    }
  }
  return cells;
}

}  // namespace

TEST_CASE("the mask of a sphere is its outline") {
  Sea sea;
  sea.tiles.insert(object_at(solids::Sphere{2.0}, {0.0, 10.0, 0.0}));
  const auto report = sea.report();
  const msg::Labels labels = std::get<1>(report.messages).value();
  const Cells expected = sphere_cells(std::get<0>(report.messages).value(), 10.0, 1.0);
  REQUIRE(expected.size() > 1500);
  CHECK(iou(cells_of(labels.mask_run, 0), expected) > 0.98);
  CHECK(cells_of(labels.mask_run, 0) == cells_of(labels.layer_run, 0));
  CHECK(labels.shadow_run.empty());  // there is no seabed in range

  REQUIRE(labels.objects.size() == 1);
  const msg::LabelledObject& object = labels.objects[0];
  CHECK(object.instance == 1);
  CHECK(object.class_name == "mine");
  CHECK(object.class_id == 3);
  CHECK_THAT(object.inside, WithinAbs(1.0, 0.03));
  CHECK(object.visible == 1.0);
  CHECK(object.occluded == 0.0);
  CHECK_THAT(object.aspect_rad, WithinAbs(std::numbers::pi, 1e-2));  // the head lies south of it
  CHECK_THAT(object.range_m, WithinAbs(9.3, 0.2));
  const auto [low, high] = std::ranges::minmax_element(expected, {}, [](const auto& cell) { return cell.second; });
  CHECK_THAT(static_cast<double>(object.box[1]), WithinAbs(low->second, 1.0));
  // Its facets, which lie a thousandth of its size off it, reach a little behind its outline: sqrt(2 sagitta radius).
  CHECK_THAT(static_cast<double>(object.box[3]), WithinAbs(high->second + 1, 5.0));
  CHECK_THAT(static_cast<double>(object.box[0]), WithinAbs(expected.begin()->first, 1.0));
  CHECK_THAT(static_cast<double>(object.box[2]), WithinAbs(expected.rbegin()->first + 1, 1.0));
}

TEST_CASE("labels are not drawn: speckle and noise leave them as they are") {
  const auto labels_with = [](const auto& change) {
    ForwardLookingConfig config = plain();
    change(config);
    Sea sea(config, [](double, double north) { return -13.0 - 0.01 * north; });
    sea.tiles.insert(object_at(solids::Sphere{0.6}, {1.0, 8.0, -2.7}));
    return sea.labels();
  };
  const msg::Labels labels = labels_with([](ForwardLookingConfig&) {});
  REQUIRE(labels.shadow_run.rows() > 10);
  const auto same = [&](const msg::Labels& other) {
    return other.mask_run == labels.mask_run && other.shadow_run == labels.shadow_run &&
           other.shadow_db == labels.shadow_db && other.layer_run == labels.layer_run;
  };
  CHECK(same(labels_with([](ForwardLookingConfig& config) { world_of(config).seed = 77; })));
  CHECK(same(labels_with([](ForwardLookingConfig& config) { config.effects.speckle = false; })));
  CHECK(labels_with([](ForwardLookingConfig& config) { config.quality = 1.0; }).mask_run == labels.mask_run);
  CHECK_FALSE(same(labels_with([](ForwardLookingConfig& config) { config.source_level_db = 60.0; })));  // below noise
}

TEST_CASE("what stands in front hides what is behind it") {
  Sea sea;
  sea.tiles.insert(object_at(solids::Sphere{0.5}, {0.0, 5.0, 0.0}, 1));
  sea.tiles.insert(object_at(solids::Sphere{2.0}, {0.0, 12.0, 0.0}, 2));
  const msg::Labels labels = sea.labels();
  REQUIRE(labels.objects.size() == 2);
  CHECK(labels.objects[0].visible == 1.0);
  const auto cap = [](double radius_m, double away_m) { return 1.0 - std::sqrt(1.0 - std::pow(radius_m / away_m, 2)); };
  const double hidden = cap(0.25, 5.0) / cap(1.0, 12.0);
  CHECK_THAT(labels.objects[1].occluded, WithinAbs(hidden, 0.02));
  CHECK_THAT(labels.objects[1].visible, WithinAbs(1.0 - hidden, 0.02));
  // Beams through the middle of the front one have nothing of the other before its hidden part ends.
  const Cells front = cells_of(labels.mask_run, 0), back = cells_of(labels.mask_run, 1);
  for (const auto& cell : front) CHECK_FALSE(back.contains(cell));
}

TEST_CASE("the strongest samples of an object lie in its mask, also while the head moves and turns") {
  ForwardLookingConfig config = plain();
  config.effects.noise = false;
  Sea sea(config);
  for (int i = 1; i <= 20; ++i) {
    const double t = 0.005 * i;
    sea.truth.push(from_seconds(t).count(),
                   {kHead + t * frames::Vec3(0.0, 4.0, 0.0), frames::enu_from_body({0.5 * t, 0.0, 0.0})});
  }
  sea.tiles.insert(object_at(solids::Sphere{0.1}, {1.0, 15.0, 0.0}));
  const auto report = sea.report();
  const msg::Ping ping = std::get<0>(report.messages).value();
  const Cells mask = cells_of(std::get<1>(report.messages).value().mask_run, 0);
  REQUIRE_FALSE(mask.empty());
  const auto all = ping.amplitude_upa.flat();
  const auto strongest = static_cast<std::size_t>(std::ranges::max_element(all) - all.begin());
  const auto beam = static_cast<int>(strongest / ping.amplitude_upa.cols());
  const auto sample = static_cast<int>(strongest % ping.amplitude_upa.cols());
  bool near = false;  // a sphere of 0.1 m in a beam of 1 degree: within a beam's spacing or two, and its depth
  for (const auto& [b, k] : mask) near = near || (std::abs(b - beam) <= 3 && std::abs(k - sample) <= 3);
  CHECK(near);
}

TEST_CASE("a wall of the seabed has a shadow of its own, which is no object's") {
  ForwardLookingConfig config = plain();
  Sea sea(config, [](double, double north) { return std::abs(north - 8.0) < 0.6 ? -11.5 : -13.0; });
  const msg::Labels labels = sea.labels();
  CHECK(labels.objects.empty());
  CHECK(labels.mask_run.empty());
  const Cells own = cells_of(labels.shadow_run, -1);
  REQUIRE_FALSE(own.empty());
  // Ahead: from the crest's far edge, 1.5 m below the head and 8.5 m ahead, to twice that on the seabed 3 m below.
  const int ahead = static_cast<int>(config.beams) / 2;
  int first = 1 << 30, last = 0;
  for (const auto& [beam, sample] : own) {
    if (beam == ahead) first = std::min(first, sample), last = std::max(last, sample);
  }
  const auto report = sea.report();
  const double metre = 2.0 / kSpeed_mps / std::get<0>(report.messages)->sample_period_s;  // in samples
  CHECK_THAT(first, WithinAbs(std::hypot(8.5, 1.5) * metre, 5.0));
  CHECK_THAT(last, WithinAbs(std::hypot(17.0, 3.0) * metre, 5.0));
}

TEST_CASE("a body beside the image at transmission is labelled where the head's turn brings it in") {
  ForwardLookingConfig config = plain();
  Sea sea(config);
  for (int i = 1; i <= 20; ++i) {
    const double t = 0.005 * i;
    sea.truth.push(from_seconds(t).count(), {kHead, frames::enu_from_body({3.0 * t, 0.0, 0.0})});  // to starboard
  }
  const double edge_rad = 0.5 * config.aperture_rad + 0.035;
  sea.tiles.insert(object_at(solids::Sphere{0.2}, 15.0 * frames::Vec3(std::sin(edge_rad), std::cos(edge_rad), 0.0), 7));
  const msg::Labels labels = sea.labels();
  REQUIRE(labels.mask_run.rows() > 0);
  REQUIRE(labels.objects.size() == 1);
  CHECK(labels.objects[0].instance == 7);
  CHECK(labels.objects[0].inside == 0.0);  // at transmission
  CHECK(labels.objects[0].box[2] <= labels.beams);
}
