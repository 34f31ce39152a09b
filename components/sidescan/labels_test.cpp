// Labels of a sidescan against what geometry says: masks and shadows of a box that stands along the track.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "components/sidescan/head.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"
#include "components/terrain/object_message.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

constexpr double kSpeed_mps = 1500.0, kAltitude_m = 10.0;
const frames::Vec3 kHead(0.0, 0.0, -5.0);

SidescanConfig plain() {
  SidescanConfig config;
  world_of(config).water.profile.sound_speed_mps = kSpeed_mps;
  world_of(config).seabed.sediments = {{0, seabed::Lambert{-25.0}}, {1, seabed::Lambert{-10.0}}};
  config.process = "side";
  config.channels[0].range_m = 60.0;
  config.labels = LabelKind::kMasks;
  config.effects.multipath = false;
  return config;
}

msg::Object box_at(double east_m, const frames::Vec3& size_m, std::int64_t instance) {
  msg::Object object;
  object.number = object.instance = instance;
  object.name = "box";
  object.class_name = "box";
  object.class_id = 1;
  put_shape(solids::Box{size_m}, object);
  object.position_enu_m = {east_m, 0.0, kHead.z() - kAltitude_m + 0.5 * size_m.z()};
  object.sediment = 1;
  return object;
}

struct Labelled {
  msg::Ping ping;
  msg::Labels labels;
};

Sidescan::Report report_with(const std::vector<msg::Object>& objects, const SidescanConfig& config) {
  TileSet tiles(config.lod);
  tiles.insert(tile_of(256.0, 1.0, [](double, double) { return kHead.z() - kAltitude_m; }));
  for (const msg::Object& object : objects) tiles.insert(object);
  frames::PoseHistory truth{10'000'000'000};
  truth.push(0, {kHead, frames::enu_from_ned()});
  Sidescan head(config, 0);
  const HeadSettings settings = config.start_of(config.channels[0]);
  return report_of(head, {0, SimTime{0}, settings.range_m}, settings, around(truth, tiles.scene()));
}

Labelled labelled(const std::vector<msg::Object>& objects, const SidescanConfig& config = plain()) {
  const auto report = report_with(objects, config);
  return {std::get<0>(report.messages).value(), std::get<2>(report.messages).value()};
}

struct Interval {
  double first = 0.0, end = 0.0;
};

Interval extent(const msg::Array<std::int32_t>& runs, std::int32_t whose, std::int32_t side) {
  Interval all{1e9, 0.0};
  for (std::size_t i = 0; i < runs.rows(); ++i) {
    if (runs(i, 0) != whose || runs(i, 1) != side) continue;
    all = {std::min(all.first, static_cast<double>(runs(i, 2))), std::max(all.end, static_cast<double>(runs(i, 3)))};
  }
  return all;
}

std::int32_t count(const msg::Array<std::int32_t>& runs, std::int32_t whose) {
  std::int32_t samples = 0;
  for (std::size_t i = 0; i < runs.rows(); ++i) samples += runs(i, 0) == whose ? runs(i, 3) - runs(i, 2) : 0;
  return samples;
}

}  // namespace

TEST_CASE("mask and shadow of a box are where they must be, to a sample") {
  for (const double middle_m : {12.0, 25.0, -30.0}) {
    const double near_m = std::abs(middle_m) - 0.5, far_m = near_m + 1.0, height_m = 1.5;
    const Labelled got = labelled({box_at(middle_m, {1.0, 8.0, height_m}, 1)});
    const double metre = 2.0 / kSpeed_mps / got.ping.sample_period_s;  // in samples
    const int side = middle_m > 0.0 ? 1 : 0;
    const double above_m = kAltitude_m - height_m;
    // The near face and the top, from the nearest edge to the foot or the far edge.
    const Interval mask = extent(got.labels.mask_run, 0, side);
    CHECK_THAT(mask.first, WithinAbs(std::hypot(near_m, above_m) * metre, 1.0));
    const double mask_end = std::max(std::hypot(near_m, kAltitude_m), std::hypot(far_m, above_m)) * metre;
    CHECK_THAT(mask.end, WithinAbs(mask_end + 1.0, 1.0));
    // The seabed behind it, to the ray over its far edge.
    const Interval shadow = extent(got.labels.shadow_run, 0, side);
    CHECK_THAT(shadow.first, WithinAbs(mask.end, 1.0));
    CHECK_THAT(shadow.end, WithinAbs(std::hypot(far_m * kAltitude_m / above_m, kAltitude_m) * metre, 1.0));
    CHECK(count(got.labels.shadow_run, 0) >= static_cast<std::int32_t>(shadow.end - shadow.first) - 1);
    REQUIRE(got.labels.objects.size() == 1);
    CHECK(got.labels.objects[0].box[0] == side);
    CHECK(got.labels.objects[0].shadow_box[3] == static_cast<std::int64_t>(shadow.end));
    for (const std::uint8_t db : got.labels.shadow_db.flat()) CHECK((db >= 6 && db <= 60));
  }
}

TEST_CASE("a shadow belongs to what blocks it first, and one in it has none of its own") {
  const Labelled both =
      labelled({box_at(12.0, {1.0, 8.0, 3.0}, 1), box_at(15.0, {0.5, 8.0, 0.5}, 2)});  // the second is in the dark
  REQUIRE(both.labels.objects.size() == 2);
  CHECK(both.labels.objects[1].visible == 0.0);
  CHECK(both.labels.objects[1].occluded == 1.0);
  CHECK(both.labels.objects[1].inside < 0.2);  // of 8 m most lies outside the beam
  CHECK(count(both.labels.mask_run, 1) == 0);
  CHECK(count(both.labels.shadow_run, 1) == 0);
  const Labelled one = labelled({box_at(12.0, {1.0, 8.0, 3.0}, 1)});
  const Interval with = extent(both.labels.shadow_run, 0, 1), without = extent(one.labels.shadow_run, 0, 1);
  CHECK_THAT(with.first, WithinAbs(without.first, 1.0));
  CHECK_THAT(with.end, WithinAbs(without.end, 1.0));
}

TEST_CASE("a thing narrower than a tenth of the beam leaves no mask, and one that lets most through no shadow") {
  const Labelled got = labelled({box_at(25.0, {0.3, 0.005, 0.5}, 1)});
  CHECK(got.labels.mask_run.empty());
  const Labelled half = labelled({box_at(25.0, {0.3, 0.05, 0.5}, 1)});
  CHECK(count(half.labels.mask_run, 0) > 0);
  CHECK(count(half.labels.shadow_run, 0) == 0);
}

TEST_CASE("labels are only made when asked for, and leave the ping as it is") {
  SidescanConfig config = plain();
  const std::vector<msg::Object> objects{box_at(25.0, {1.0, 8.0, 1.5}, 1)};
  const msg::Ping with = labelled(objects, config).ping;
  config.labels = LabelKind::kNone;
  CHECK_FALSE(std::get<2>(Sidescan(config, 0).outputs()).declared);
  const auto report = report_with(objects, config);
  CHECK_FALSE(std::get<2>(report.messages));
  CHECK(std::get<0>(report.messages)->amplitude_upa == with.amplitude_upa);
}

TEST_CASE("what sources of a sidescan send adds up to its ping without speckle") {
  SidescanConfig config = plain();
  config.labels = LabelKind::kEnergies;
  config.effects.multipath = true;
  config.effects.speckle = config.effects.noise = config.effects.interference = false;
  const auto report = report_with({box_at(20.0, {1.0, 2.0, 1.0}, 1)}, config);
  const msg::Ping& ping = std::get<0>(report.messages).value();
  const msg::Energies& energies = std::get<3>(report.messages).value();
  std::vector<double> sum(ping.amplitude_upa.size());
  std::array<double, 2> box{};  // port, starboard
  std::set<std::pair<std::string, std::string>> sources;
  std::size_t next = 0;
  for (std::size_t i = 0; i < energies.run.rows(); ++i) {
    const msg::EnergySource& source = energies.sources[static_cast<std::size_t>(energies.run(i, 0))];
    sources.emplace(source.kind, source.path);
    for (std::int64_t k = energies.run(i, 2); k < energies.run(i, 3); ++k, ++next) {
      const auto upa2 = static_cast<double>(energies.energy_upa2.data()[next]);
      sum[static_cast<std::size_t>(energies.run(i, 1) * energies.samples + k)] += upa2;
      if (source.kind == "object") box[static_cast<std::size_t>(energies.run(i, 1))] += upa2;
    }
  }
  REQUIRE(next == energies.energy_upa2.size());
  CHECK(box[1] > 0.0);
  CHECK(box[0] < 1e-3 * box[1]);  // what the port face's back receives
  CHECK(sources.contains({"seabed", "direct"}));
  CHECK(sources.contains({"object", "direct"}));
  CHECK(sources.contains({"object", "surface"}));
  double largest = 0.0, worst = 0.0;
  const auto square = [&](std::size_t k) {
    const auto amplitude = static_cast<double>(ping.amplitude_upa.data()[k]);
    return amplitude * amplitude;
  };
  for (std::size_t k = 0; k < sum.size(); ++k) largest = std::max(largest, square(k));
  REQUIRE(largest > 0.0);
  for (std::size_t k = 0; k < sum.size(); ++k)
    worst = std::max(worst, std::abs(sum[k] - square(k)) / (1e-4 * square(k) + 1e-6 * largest));
  CHECK(worst < 1.0);
}
