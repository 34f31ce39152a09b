#include "components/multibeam/head.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "components/multibeam/ping_message.h"
#include "components/multibeam/testing/head.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

using Field = std::vector<std::complex<float>>;

/// 32 beams over 20 m of water that scatters, 2 m below a calm surface.
MultibeamConfig small() {
  MultibeamConfig config = head_in_plain_water();
  config.beams = 32;
  config.receive_beamwidth_rad = config.transmit_beamwidth_rad = 4.0 * MultibeamConfig::kDegree;
  config.quality = 0.05;
  world_of(config).water.noise_level_db = 70.0;
  world_of(config).water.scattering_layers = {{0.0, 100.0, -60.0}};
  return config;
}

frames::PoseHistory moving() {
  frames::PoseHistory truth(1'000'000'000);
  for (int i = 0; i <= 20; ++i) {
    frames::Pose pose;
    pose.position_enu_m = {0.03 * i, 0.0, -2.0};
    pose.enu_from_body = frames::enu_from_body({0.0, 0.0, 0.002 * i});
    truth.push(10'000'000 * i, pose);
  }
  return truth;
}

trace::Scene& seabed() {
  static TileSet tiles;
  if (tiles.scene().size() == 0) {
    tiles.insert(tile_of(200.0, 0.5, [](double east, double) { return -22.0 + 0.3 * std::sin(0.3 * east); }));
  }
  return tiles.scene();
}

struct Received {
  Field starboard;
  std::vector<float> amplitude_upa;
  msg::Ping ping;
};

Received received(const MultibeamConfig& config, bool phase = false) {
  const Multibeam head(config, 0);
  const PingEvent event{7, SimTime{0}, 45.0};
  const Steering steering = steer(config, config.swath_rad, {});
  const HeadSettings settings = config.start();
  Multibeam::Memory memory;
  const auto sectors = receive_echoes(head, event, settings, steering, moving(), seabed(), memory);
  Received result;
  for (const SectorBeams& sector : sectors) {
    const auto half = sector.halves.positive_upa;
    result.starboard.insert(result.starboard.end(), half.begin(), half.end());
    const auto amplitude = sector.image.amplitude_upa;
    result.amplitude_upa.insert(result.amplitude_upa.end(), amplitude.begin(), amplitude.end());
  }
  result.ping = ping_message(config, event, settings, steering, applied_settings(config, event, settings, steering),
                             {memory.amplitude_upa, sectors, phase});
  return result;
}

float largest(const Field& field) {
  float most = 0.0F;
  for (const auto value : field) most = std::max(most, std::abs(value));
  return most;
}

Field difference(const Field& a, const Field& b) {
  Field result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

}  // namespace

TEST_CASE("one effect switched off leaves the draws of the others alone") {
  const MultibeamConfig all = small();
  const Field whole = received(all).starboard;
  const std::pair<const char*, bool Effects::*> switches[] = {{"refraction", &Effects::refraction},
                                                              {"absorption", &Effects::absorption},
                                                              {"noise", &Effects::noise},
                                                              {"volume", &Effects::volume},
                                                              {"multipath", &Effects::multipath},
                                                              {"motion", &Effects::motion},
                                                              {"tvg", &Effects::tvg},
                                                              {"quantisation", &Effects::quantisation}};
  const auto without = [&](bool Effects::*one, bool Effects::*other) {
    MultibeamConfig config = all;
    config.effects.*one = config.effects.*other = false;
    return received(config).starboard;
  };
  // What noise (or the volume) adds to the field is the same with any other effect off, to the rounding of its sum with
  // stronger echoes: 2^-24 of the strongest, through two transforms.
  for (const auto added : {&Effects::noise, &Effects::volume}) {
    const Field part = difference(whole, without(added, added));
    CHECK(largest(part) > 1e-4F * largest(whole));
    for (const auto& [name, off] : switches) {
      if (off == added || (added == &Effects::volume && off == &Effects::absorption)) continue;  // the volume's own
      INFO(name);
      const Field alone = difference(without(off, off), without(off, added));
      CHECK(largest(difference(alone, part)) < 2e-6F * largest(whole));
    }
  }
}

TEST_CASE("switches change what they name") {
  const MultibeamConfig all = small();
  const auto amplitudes = [&](const std::function<void(MultibeamConfig&)>& change) {
    MultibeamConfig config = all;
    config.effects.noise = config.effects.volume = false;
    change(config);
    return received(config).amplitude_upa;
  };
  const auto as_is = amplitudes([](MultibeamConfig&) {});
  CHECK(amplitudes([](MultibeamConfig&) {}) == as_is);
  CHECK(amplitudes([](MultibeamConfig& c) { c.effects.tvg = false; }) == as_is);           // acts on counts only
  CHECK(amplitudes([](MultibeamConfig& c) { c.effects.quantisation = false; }) == as_is);  // likewise
  CHECK(amplitudes([](MultibeamConfig& c) { c.effects.refraction = false; }) == as_is);    // in isovelocity water
  for (const auto off : {&Effects::absorption, &Effects::directivity, &Effects::side_lobes, &Effects::speckle,
                         &Effects::multipath, &Effects::motion}) {
    CHECK_FALSE(amplitudes([&](MultibeamConfig& c) { c.effects.*off = false; }) == as_is);
  }
}

TEST_CASE("calm surface echoes arrive after 2 d / c; none with multipath off or in waves") {
  MultibeamConfig config = small();
  config.effects.noise = config.effects.volume = false;
  config.back_loss_db = 10.0;
  const auto at_surface = [&](double above_m = 2.0) {
    const Received echoes = received(config);
    const auto row = echoes.ping.amplitude_upa.row(16);
    const auto k = static_cast<std::size_t>(2.0 * above_m / 1500.0 * config.sample_rate_hz) + 1;
    return static_cast<double>(row[k]);
  };
  // SL - 20 log 4 m - 0.07 x 4 - 2 x 10 dB behind the face, and what a beam of 4 degrees loses 2 degrees beside its
  // axis: 3 dB.
  const double level_db = 20.0 * std::log10(at_surface());
  CHECK_THAT(level_db, WithinAbs(215.0 - 12.04 - 0.28 - 20.0 - 3.0, 1.0));

  world_of(config).vertical.tide = vertical::Tide(3.0);  // 5 m overhead: 20 log 10 m, 0.07 x 10
  CHECK(at_surface(2.0) == 0.0);
  CHECK_THAT(20.0 * std::log10(at_surface(5.0)), WithinAbs(215.0 - 20.0 - 0.7 - 20.0 - 3.0, 1.0));
  world_of(config).vertical.tide = vertical::Tide();

  config.effects.multipath = false;
  CHECK(at_surface() == 0.0);
  config.effects.multipath = true;
  world_of(config).water.wind_speed_mps = 5.0;
  CHECK(at_surface() == 0.0);
}

TEST_CASE("counts are amplitudes with the operator's gain, to half a step, and saturate") {
  MultibeamConfig config = small();
  const Received plain = received(config);
  config.converter = {8, 3e8};
  const Received counted = received(config);
  CHECK(counted.amplitude_upa == plain.amplitude_upa);  // detection sees amplitudes before the converter
  const msg::Ping& ping = counted.ping;
  REQUIRE(ping.amplitude_upa.size() == 0);
  REQUIRE(ping.amplitude_count.size() == plain.amplitude_upa.size());
  const auto samples = static_cast<std::size_t>(ping.amplitude_count.cols());
  int saturated = 0;
  for (std::size_t i = 0; i < plain.amplitude_upa.size(); ++i) {
    const double range_m = std::max(1.0, 750.0 * static_cast<double>(i % samples) * ping.sample_period_s);
    const double gain_db = 30.0 * std::log10(range_m) + 2.0 * 0.07 * range_m;
    const double step = static_cast<double>(plain.amplitude_upa[i]) * std::pow(10.0, gain_db / 20.0) / ping.count_upa;
    saturated += step > 255.5;
    REQUIRE_THAT(static_cast<double>(ping.amplitude_count[i]), WithinAbs(std::min(step, 255.0), 0.51));
  }
  CHECK(saturated > 0);
  config.effects.tvg = false;
  CHECK(received(config).ping.applied.gain_spreading_db == 0.0);
}

TEST_CASE("the phase of a ping is that between the halves; without speckle there is none") {
  MultibeamConfig config = small();
  const Received echoes = received(config, true);
  REQUIRE(echoes.ping.phase_rad.size() == echoes.amplitude_upa.size());
  for (const float phase : echoes.ping.phase_rad.flat()) REQUIRE(std::abs(phase) <= 3.1416F);
  CHECK(received(config).ping.phase_rad.size() == 0);
  config.effects.speckle = false;
  CHECK(received(config, true).ping.phase_rad.size() == 0);
}

TEST_CASE("each sector is sent at its own time and frequency, and received by its own beams") {
  MultibeamConfig config = small();
  config.effects.noise = config.effects.volume = config.effects.multipath = false;
  config.sectors = {{.frequency_hz = 280e3}, {.frequency_hz = 300e3, .delay_s = 4e-3}, {.frequency_hz = 320e3}};
  const Received echoes = received(config);
  const msg::Ping& ping = echoes.ping;
  REQUIRE(ping.beam_sector.size() == 32);
  CHECK(ping.beam_sector[0] == 0);
  CHECK(ping.beam_sector[16] == 1);
  CHECK(ping.beam_sector[31] == 2);
  REQUIRE(ping.applied.sectors.size() == 3);
  CHECK(ping.applied.sectors[1].delay_s == 4e-3);
  CHECK(ping.applied.sectors[2].frequency_hz == 320e3);

  // The nadir beam receives the seabed 20 m below (0.3 m of relief) later by the delay.
  const auto row = ping.amplitude_upa.row(16);
  const float strongest = *std::max_element(row.begin(), row.end());
  const auto first = std::find_if(row.begin(), row.end(), [&](float a) { return a > 0.2F * strongest; });
  CHECK_THAT(static_cast<double>(first - row.begin()) * ping.sample_period_s, WithinAbs(0.004 + 0.0267, 0.0006));
}

TEST_CASE("where two sectors join each is sent with half its amplitude") {
  MultibeamConfig config = small();
  config.effects.noise = config.effects.volume = config.effects.multipath = config.effects.speckle = false;
  config.effects.interference = false;
  config.quality = 0.5;
  const Received one = received(config);
  config.sectors = {{.share = 10.0, .frequency_hz = 300e3}, {.share = 21.0, .frequency_hz = 300e3}};
  const Received two = received(config);
  const auto energy = [](const Received& of, std::size_t beam) {
    double sum = 0.0;
    for (const float a : of.ping.amplitude_upa.row(beam)) sum += static_cast<double>(a) * a;
    return sum;
  };
  // Rays differ: some hundred of them share a beam, and their mean is good to half a decibel.
  for (const std::size_t inside : {4U, 16U, 24U}) {
    CHECK_THAT(10.0 * std::log10(energy(two, inside) / energy(one, inside)), WithinAbs(0.0, 0.5));
  }
  // The edge is the axis of beam 10: a quarter of the power there, none to one side and all of it to the other, and
  // half of the beam's width lies within the edge's 0.1 of sine.
  const double edge_db = 10.0 * std::log10(energy(two, 10) / energy(one, 10));
  CHECK(edge_db < -3.0);
  CHECK(edge_db > -6.5);
}

TEST_CASE("a sector receives the others as its filter passes them") {
  MultibeamConfig config = small();
  config.effects.noise = config.effects.volume = config.effects.multipath = false;
  const auto cross_talk = [&](double frequency_hz, double rejection_db) {
    config.sectors = {{.frequency_hz = 300e3}, {.frequency_hz = frequency_hz, .delay_s = 4e-3}};
    config.sector_rejection_db = rejection_db;
    MultibeamConfig apart = config;
    apart.effects.interference = false;
    return difference(received(config).starboard, received(apart).starboard);
  };
  // Beside the band: by the rejection, to the rounding of fields that are some hundred times stronger.
  const Field weaker = cross_talk(330e3, 40.0), loud = cross_talk(330e3, 20.0);
  REQUIRE(largest(loud) > 0.0F);
  Field scaled = weaker;
  for (auto& value : scaled) value *= 10.0F;
  CHECK(largest(difference(scaled, loud)) < 1e-3F * largest(loud));

  // In the band: where both are sent alike, the beam detects the bottom again 4 ms later.
  config.effects.speckle = false;
  config.sectors = {{.share = 10.0, .frequency_hz = 300e3}, {.share = 21.0, .frequency_hz = 300e3, .delay_s = 4e-3}};
  const auto again_db = [&] {
    const msg::Ping ping = received(config).ping;
    const auto energy = [&](double from_s) {  // of the beam on the edge, 23 degrees to port, and its 3.5 ms of bottom
      double sum = 0.0;
      for (double t = from_s; t < from_s + 3.5e-3; t += ping.sample_period_s) {
        sum += std::pow(static_cast<double>(ping.amplitude_upa(10, static_cast<std::size_t>(t / ping.sample_period_s))),
                        2);
      }
      return sum;
    };
    return 10.0 * std::log10(energy(32e-3) / energy(28e-3));
  };
  CHECK_THAT(again_db(), WithinAbs(0.0, 1.5));
  config.effects.interference = false;
  CHECK(again_db() > 20.0);  // the edge is the second's
}
