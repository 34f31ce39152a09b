// Energies of a forward-looking head: what each source sends, against the head's own pings.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numeric>
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
  world_of(config).seabed.sediments = {{0, seabed::Lambert{-25.0}}, {1, seabed::Lambert{-15.0}}};
  config.process = "eye";
  config.beams = 64;
  config.range_m = 20.0;
  config.pulse.most_samples = 400;
  config.labels = LabelKind::kEnergies;
  config.converter.bits = 0;
  return config;
}

msg::Object object_at(const solids::Solid& solid, const frames::Vec3& at, std::int64_t instance, bool smooth) {
  msg::Object object;
  object.number = object.instance = instance;
  object.name = "target";
  object.class_name = "mine";
  object.class_id = 3;
  object.smooth = smooth;
  put_shape(solid, object);
  object.position_enu_m = {at.x(), at.y(), at.z()};
  object.sediment = 1;
  return object;
}

struct Sea {
  explicit Sea(const ForwardLookingConfig& of, bool smooth = false)
      : config(of), tiles(of.lod, kSpeed_mps / of.frequency_hz) {
    tiles.insert(tile_of(64.0, 0.5, [](double, double north) { return -13.0 - 0.02 * north; }));
    tiles.insert(object_at(solids::Sphere{1.2}, {0.5, 8.0, -12.6}, 1, smooth));
    tiles.insert(object_at(solids::Sphere{1.0}, {-1.0, 11.0, -12.2}, 2, false));
    truth.push(0, {kHead, frames::enu_from_ned()});
  }
  ForwardLooking::Report report() {
    ForwardLooking head(config, 0);
    return report_of(head, {0, SimTime{0}, config.range_m}, config.start(), around(truth, tiles.scene(), kSpeed_mps));
  }

  ForwardLookingConfig config;
  TileSet tiles;
  frames::PoseHistory truth{10'000'000'000};
};

struct Image {
  msg::Ping ping;
  msg::Labels labels;
  msg::Energies energies;
};
Image image_of(const ForwardLookingConfig& config, bool smooth = false) {
  auto report = Sea(config, smooth).report();
  return {std::get<0>(report.messages).value(), std::get<1>(report.messages).value(),
          std::get<2>(report.messages).value()};
}

/// What sources send, beam by sample: those of which `wanted` says so.
std::vector<double> sum_of(
    const msg::Energies& energies,
    const std::function<bool(const msg::EnergySource&)>& wanted = [](const auto&) { return true; }) {
  std::vector<double> sum(static_cast<std::size_t>(energies.beams * energies.samples));
  std::size_t next = 0;
  for (std::size_t i = 0; i < energies.run.rows(); ++i) {
    const bool counts = wanted(energies.sources[static_cast<std::size_t>(energies.run(i, 0))]);
    for (std::int64_t k = energies.run(i, 2); k < energies.run(i, 3); ++k, ++next) {
      if (counts)
        sum[static_cast<std::size_t>(energies.run(i, 1) * energies.samples + k)] +=
            static_cast<double>(energies.energy_upa2.data()[next]);
    }
  }
  REQUIRE(next == energies.energy_upa2.size());
  return sum;
}

ForwardLookingConfig without_draws(ForwardLookingConfig config) {
  config.effects.speckle = config.effects.noise = config.effects.volume = config.effects.interference = false;
  return config;
}

}  // namespace

TEST_CASE("what all sources send is the ping without speckle") {
  const bool smooth = GENERATE(false, true);
  const Image image = image_of(without_draws(plain()), smooth);
  const std::vector<double> sum = sum_of(image.energies);
  REQUIRE(sum.size() == image.ping.amplitude_upa.size());
  std::vector<double> squares;
  for (const float amplitude : image.ping.amplitude_upa.flat())
    squares.push_back(static_cast<double>(amplitude) * static_cast<double>(amplitude));
  const double largest = std::ranges::max(squares);
  double worst = 0.0;
  for (std::size_t k = 0; k < sum.size(); ++k)
    worst = std::max(worst, std::abs(sum[k] - squares[k]) / (1e-4 * squares[k] + 1e-6 * largest));
  CHECK(worst < 1.0);

  const auto has = [&](const char* kind, const char* path, std::int64_t instance) {
    return std::ranges::any_of(image.energies.sources, [&](const msg::EnergySource& source) {
      return source.kind == kind && source.path == path && source.instance == instance;
    });
  };
  CHECK(image.energies.sources.front().kind == "noise");
  CHECK(has("seabed", "direct", 0));
  CHECK(has("seabed", "surface", 0));
  CHECK(has("object", "direct", 1));
  CHECK(has("object", "direct", 2));
  CHECK(has("object", "surface", 2));
  CHECK(has("object", "surface", 1) == !smooth);  // smooth bodies have direct echoes only
}

TEST_CASE("an object sends most where its mask is") {
  ForwardLookingConfig config = plain();
  config.effects.multipath = false;
  const Image image = image_of(config);
  for (const std::int64_t instance : {1, 2}) {
    const std::vector<double> own =
        sum_of(image.energies, [&](const msg::EnergySource& source) { return source.instance == instance; });
    const std::vector<double> all = sum_of(image.energies);
    std::size_t cells = 0, most = 0;
    for (std::size_t i = 0; i < image.labels.layer_run.rows(); ++i) {
      const auto& run = image.labels.layer_run;
      if (image.labels.objects[static_cast<std::size_t>(run(i, 0))].instance != instance) continue;
      for (std::int32_t k = run(i, 2); k < run(i, 3); ++k, ++cells) {
        const auto cell = static_cast<std::size_t>(run(i, 1) * image.labels.samples + k);
        most += own[cell] > 0.5 * all[cell] ? 1 : 0;
      }
    }
    REQUIRE(cells > 10);
    CAPTURE(instance, cells, most);
    CHECK(static_cast<double>(most) > 0.7 * static_cast<double>(cells));
  }
}

TEST_CASE("energies and labels are of the scene, not of the draws") {
  ForwardLookingConfig config = plain();
  const Image one = image_of(config);
  config.speckle_seed = 77;
  const Image other = image_of(config);
  CHECK(std::ranges::equal(one.energies.energy_upa2.flat(), other.energies.energy_upa2.flat()));
  CHECK(std::ranges::equal(one.energies.run.flat(), other.energies.run.flat()));
  CHECK(std::ranges::equal(one.labels.mask_run.flat(), other.labels.mask_run.flat()));
  CHECK(std::ranges::equal(one.labels.shadow_run.flat(), other.labels.shadow_run.flat()));
  CHECK_FALSE(std::ranges::equal(one.ping.amplitude_upa.flat(), other.ping.amplitude_upa.flat()));

  config.speckle_seed = 0;
  config.labels = LabelKind::kNone;
  auto plain_report = Sea(config).report();
  CHECK_FALSE(std::get<2>(plain_report.messages));
  CHECK(std::ranges::equal(std::get<0>(plain_report.messages)->amplitude_upa.flat(), one.ping.amplitude_upa.flat()));
}

TEST_CASE("energies are what pings have in the mean over speckle and noise") {
  ForwardLookingConfig config = plain();
  config.source_level_db = 190.0;  // far out there is noise
  world_of(config).water.scattering_layers = {{0.0, 50.0, -55.0}};
  const std::vector<double> expected = sum_of(image_of(config).energies);
  config.labels = LabelKind::kNone;
  constexpr int kSeeds = 300;
  std::vector<double> mean(expected.size());
  Sea sea(config);
  for (int seed = 1; seed <= kSeeds; ++seed) {
    sea.config.speckle_seed = 1000 + static_cast<std::uint64_t>(seed);
    const auto report = sea.report();
    const auto amplitude = std::get<0>(report.messages)->amplitude_upa.flat();
    for (std::size_t k = 0; k < mean.size(); ++k)
      mean[k] += static_cast<double>(amplitude[k]) * static_cast<double>(amplitude[k]) / kSeeds;
  }
  // The mean of as many squares of a Gaussian is off by 1 / sqrt(seeds) of itself.
  double in_all = 0.0;
  std::size_t off = 0, counted = 0;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    if (expected[k] <= 0.0) continue;
    ++counted;
    const double ratio = mean[k] / expected[k];
    in_all += ratio;
    if (std::abs(10.0 * std::log10(ratio)) > 1.0) ++off;
  }
  REQUIRE(counted > 10'000);
  CHECK_THAT(10.0 * std::log10(in_all / static_cast<double>(counted)), WithinAbs(0.0, 0.05));
  CHECK(static_cast<double>(off) < 1e-3 * static_cast<double>(counted));
}

TEST_CASE("without an object a ping is equal, bit by bit, in all samples that neither it nor its shadow reaches") {
  ForwardLookingConfig config = plain();
  config.labels = LabelKind::kNone;
  config.effects.multipath = false;
  config.effects.absorption = false;  // it follows from the mean depth of all that rays hit
  const auto ping_with = [&](bool object) {
    TileSet tiles(config.lod, kSpeed_mps / config.frequency_hz);
    tiles.insert(tile_of(64.0, 0.5, [](double, double north) { return -13.0 - 0.02 * north; }));
    tiles.insert(object_at(solids::Sphere{1.0}, {-1.0, 14.0, -12.2}, 2, false));
    if (object) tiles.insert(object_at(solids::Sphere{0.5}, {0.5, 8.0, -12.8}, 1, false));
    frames::PoseHistory truth{10'000'000'000};
    truth.push(0, {kHead, frames::enu_from_ned()});
    ForwardLooking head(config, 0);
    auto report =
        report_of(head, {0, SimTime{0}, config.range_m}, config.start(), around(truth, tiles.scene(), kSpeed_mps));
    return std::get<0>(report.messages).value();
  };
  const msg::Ping with = ping_with(true), without = ping_with(false);
  const auto sample = [&](double range_m) {
    return static_cast<std::size_t>(2.0 * range_m / kSpeed_mps / with.sample_period_s);
  };
  std::set<std::size_t> different;
  for (std::size_t beam = 0; beam < with.amplitude_upa.rows(); ++beam) {
    for (std::size_t k = 0; k < with.amplitude_upa.cols(); ++k)
      if (with.amplitude_upa(beam, k) != without.amplitude_upa(beam, k)) different.insert(k);
  }
  REQUIRE(!different.empty());
  CAPTURE(*different.begin(), *different.rbegin(), sample(8.2), sample(11.0));
  CHECK(*different.begin() > sample(7.8));
  CHECK(*different.rbegin() < sample(11.0));
}
