// Energies of a multibeam: what each source sends to the beams of all sectors.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "components/multibeam/testing/head.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"
#include "components/terrain/object_message.h"

using namespace ensonify;

namespace {

constexpr double kDeck_m = -20.0;

MultibeamConfig with_two_sectors() {
  MultibeamConfig config = head_in_plain_water();
  world_of(config).seabed.sediments[1] = seabed::Lambert{-5.0};
  config.process = "mbes";
  config.beams = 64;
  config.swath_rad = 90.0 * MultibeamConfig::kDegree;
  config.range_m = 40.0;
  config.auto_range = false;
  config.converter.bits = 0;
  config.quality.rays = 0.25;
  config.sectors = {{.share = 1.0, .frequency_hz = 250e3, .tilt_rad = 0.0, .delay_s = 0.0},
                    {.share = 1.0, .frequency_hz = 300e3, .tilt_rad = 0.0, .delay_s = 0.002}};
  config.labels = LabelKind::kEnergies;
  config.effects.noise = false;
  return config;
}

msg::Object box_on_the_seabed() {
  msg::Object object;
  object.number = object.instance = 9;
  object.name = "crate";
  object.class_name = "box";
  object.class_id = 2;
  put_shape(solids::Box{{4.0, 3.0, 2.0}}, object);
  object.position_enu_m = {-8.0, 0.0, kDeck_m + 1.0};
  object.sediment = 1;
  return object;
}

Multibeam::Report report_of_ping(const MultibeamConfig& config) {
  TileSet tiles(config.lod);
  tiles.insert(tile_of(128.0, 0.5, [](double, double) { return kDeck_m; }));
  tiles.insert(box_on_the_seabed());
  frames::PoseHistory truth{10'000'000'000};
  truth.push(0, {frames::Vec3(0.0, 0.0, -1.0), frames::enu_from_ned()});
  Multibeam head(config, 0);
  static const std::optional<uncertainty::Navigation> kNoErrors;
  return report_of(head, {0, SimTime{0}, config.range_m}, config.start(),
                   {truth, tiles.scene(), truth, kNoErrors, 1500.0});
}

}  // namespace

TEST_CASE("what sources send to all sectors adds up to the ping without speckle") {
  MultibeamConfig config = with_two_sectors();
  config.effects.speckle = false;
  const auto report = report_of_ping(config);
  const msg::Ping& ping = std::get<0>(report.messages).value();
  const msg::Energies& energies = std::get<4>(report.messages).value();
  REQUIRE(energies.beams == 64);
  REQUIRE(energies.samples == static_cast<std::int64_t>(ping.amplitude_upa.cols()));
  CHECK(energies.first_sample_s == ping.first_sample_s);
  CHECK(energies.sample_period_s == ping.sample_period_s);
  std::vector<double> sum(ping.amplitude_upa.size()), box(sum.size());
  std::set<std::pair<std::string, std::string>> sources;
  std::size_t next = 0;
  for (std::size_t i = 0; i < energies.run.rows(); ++i) {
    const msg::EnergySource& source = energies.sources[static_cast<std::size_t>(energies.run(i, 0))];
    sources.emplace(source.kind, source.path);
    for (std::int64_t k = energies.run(i, 2); k < energies.run(i, 3); ++k, ++next) {
      const auto cell = static_cast<std::size_t>(energies.run(i, 1) * energies.samples + k);
      const auto upa2 = static_cast<double>(energies.energy_upa2.data()[next]);
      sum[cell] += upa2;
      if (source.kind == "object" && source.path == "direct") box[cell] += upa2;
    }
  }
  CHECK(sources.contains({"seabed", "direct"}));
  CHECK(sources.contains({"object", "direct"}));
  CHECK(sources.contains({"interference", "direct"}));  // of the other sector
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
  // The box lies to port, 18 to 30 degrees from nadir: beams are 1.43 degrees apart, nadir between 31 and 32.
  const msg::Soundings& soundings = std::get<1>(report.messages).value();
  int on_box = 0, elsewhere = 0;
  for (std::size_t i = 0; i < soundings.travel_time_s.size(); ++i) {
    const auto time_s = static_cast<double>(soundings.travel_time_s.data()[i]);
    if (std::isnan(time_s)) continue;
    const auto beam = static_cast<std::int64_t>(soundings.beam.empty() ? i : soundings.beam.data()[i]);
    const double delay_s = soundings.applied.sectors[soundings.sector.data()[i]].delay_s;
    const auto sample = std::lround((delay_s + time_s - energies.first_sample_s) / energies.sample_period_s);
    const auto cell = static_cast<std::size_t>(beam * energies.samples + sample);
    CAPTURE(beam, box[cell], sum[cell]);
    if (beam >= 13 && beam <= 18) {
      CHECK(box[cell] > 0.5 * sum[cell]);
      ++on_box;
    } else if (beam < 8 || beam > 22) {
      CHECK(box[cell] < 0.1 * sum[cell]);
      ++elsewhere;
    }
  }
  CHECK(on_box > 3);
  CHECK(elsewhere > 30);
}

TEST_CASE("energies of a multibeam leave its soundings and beams as they are") {
  MultibeamConfig config = with_two_sectors();
  const auto with = report_of_ping(config);
  config.labels = LabelKind::kNone;
  const auto without = report_of_ping(config);
  CHECK_FALSE(std::get<4>(without.messages));
  CHECK(std::ranges::equal(std::get<0>(with.messages)->amplitude_upa.flat(),
                           std::get<0>(without.messages)->amplitude_upa.flat()));
  CHECK(std::ranges::equal(std::get<1>(with.messages)->travel_time_s.flat(),
                           std::get<1>(without.messages)->travel_time_s.flat(),
                           [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }));
}
