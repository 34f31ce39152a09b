#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/array/line.h"
#include "kernels/seabed/sediment.h"
#include "kernels/water/absorption.h"
#include "kernels/water/noise.h"
#include "tests/physics/area_integral.h"
#include "tests/physics/mills_cross.h"
#include "tests/physics/sidescan_ping.h"

// Mean levels over medium sand [APL1994] in water of 10 degC and 35 psu against the area integral.

using namespace ensonify;
using namespace ensonify::physics;
using Catch::WithinAbs;

namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kFrequencies_hz[] = {100e3, 200e3, 300e3, 450e3, 900e3};

/// At 17 m of depth, the middle of the sidescan's paths; absorption changes by 1e-4 of itself over 5 m.
LevelSeabed medium_sand(double frequency_hz, double altitude_m) {
  return {altitude_m, water::absorption_dbpm(frequency_hz, {.depth_m = 17.0}), kSpeed_mps,
          seabed::law_of(*seabed::sediment_of("medium sand"), frequency_hz, kSpeed_mps)};
}

trace::Scene level_seabed(double height_m) {
  return scene_of(256.0, 1.0, [=](double, double) { return height_m; });
}

/// Both lines of a side of the sidescan, transmitted and received; starboard, its axis 30 degrees below the horizon.
TwoWayPattern starboard_pattern(const SidescanChannel& channel) {
  const double along = array::length_in_waves_for(channel.horizontal_beamwidth_rad);
  const double across = array::length_in_waves_for(channel.vertical_beamwidth_rad);
  const double cosine = std::cos(channel.depression_rad), sine = std::sin(channel.depression_rad);
  return [=](double forward, double starboard, double down) {
    if (starboard * cosine + down * sine < 0.0) return 0.0;  // behind the face
    const double up_the_face = down * cosine - starboard * sine;
    return std::pow(array::line_power(along, forward) * array::line_power(across, up_the_face), 2);
  };
}

Tone transmission_of(const SidescanChannel& channel) {
  return {channel.source_level_db, channel.pulse_length_s, starboard_pattern(channel),
          1.0 / array::length_in_waves_for(channel.horizontal_beamwidth_rad)};
}

}  // namespace

TEST_CASE("sidescan: level seabed gives the area integral, 20-100 m, 100-900 kHz") {
  // As a sum of mean squares. A metre of slant range holds 13 pulses with some 12 rays each in strata that leave 30 %
  // of scatter: 2.4 %, 0.1 dB.
  trace::Scene seabed = level_seabed(-22.0);
  for (const double frequency_hz : kFrequencies_hz) {
    SidescanConfig config = sidescan_of(frequency_hz);
    config.effects.speckle = false;
    const auto ping = sidescan_ping(config, seabed, {0.0, 0.0, -12.0});
    const LevelSeabed sand = medium_sand(frequency_hz, 10.0);
    const Tone tone = transmission_of(config.channels[0]);
    for (const double range_m : {20.0, 30.0, 50.0, 70.0, 100.0}) {
      const Samples about = samples_about(ping, range_m, 0.5);
      double expected = 0.0;
      for (std::size_t k = about.first; k < about.end; ++k) {
        expected += mean_square_upa2(sand, tone, sample_time_s(ping, k));
      }
      const double starboard = db(power_sum(ping, 1, about) / expected),
                   port = db(power_sum(ping, 0, about) / expected);
      INFO(frequency_hz << " Hz, " << range_m << " m: starboard " << starboard << " dB, port " << port << " dB");
      CHECK(std::abs(starboard) < 0.5);
      CHECK(std::abs(port) < 0.5);
    }
  }
}

TEST_CASE("sidescan: no range has a stripe along the track, not even in a preview") {
  // Level of each sample over the integral, of level sand 10 m below, in 16 pings 2 m apart, which share no seabed
  // within their main lobes: what their mean has over what 16 independent ones would leave.
  constexpr int kPings = 16;
  trace::Scene seabed = level_seabed(-22.0);
  const LevelSeabed sand = medium_sand(400e3, 10.0);
  for (const double quality : {0.25, 1.0}) {
    SidescanConfig config = sidescan_of(400e3);
    config.quality = quality;
    config.effects.speckle = false;
    const Tone tone = transmission_of(config.channels[0]);
    std::vector<msg::Ping> pings;
    for (int i = 0; i < kPings; ++i) pings.push_back(sidescan_ping(config, seabed, {0.0, 2.0 * i, -12.0}));
    for (const auto& [from_m, to_m] : {std::pair{10.5, 15.0}, {15.0, 25.0}, {25.0, 50.0}, {50.0, 100.0}}) {
      const Samples about = samples_about(pings[0], 0.5 * (from_m + to_m), 0.5 * (to_m - from_m));
      double of_means = 0.0, of_pings = 0.0, n = 0.0;
      for (std::size_t k = about.first; k < about.end; ++k) {
        const double expected = mean_square_upa2(sand, tone, sample_time_s(pings[0], k));
        double sum = 0.0, squares = 0.0;
        for (const msg::Ping& ping : pings) {
          const double off = power_sum(ping, 1, {k, k + 1}) / expected - 1.0;
          sum += off, squares += off * off;
        }
        of_means += std::pow(sum / kPings, 2), n += 1.0;
        of_pings += (squares - sum * sum / kPings) / (kPings - 1);
      }
      const double stripes = std::sqrt(std::max(0.0, (of_means - of_pings / kPings) / n));
      INFO("quality " << quality << ", " << from_m << " to " << to_m << " m: stripes " << db(1.0 + stripes)
                      << " dB, one ping " << db(1.0 + std::sqrt(of_pings / n)) << " dB, n " << n);
      CHECK(db(1.0 + stripes) < 0.3);
    }
  }
}

TEST_CASE("multibeam: level seabed gives the area integral, 0-70 degrees, 100-900 kHz") {
  // Mean over the echo between the first nulls of the beam, and at its axis (three pulses). Rays of reference quality,
  // 48 to a resolution cell: at the axis 0.3 / sqrt(3 x 48) = 2.5 %, 0.1 dB.
  trace::Scene seabed = level_seabed(-20.0);
  const std::vector<double> beams_deg{0, 5, 10, 20, 30, 45, 60, 70};
  std::vector<float> sines;
  for (const double deg : beams_deg) sines.push_back(static_cast<float>(std::sin(deg * kDeg)));
  for (const double frequency_hz : kFrequencies_hz) {
    const LevelSeabed sand = medium_sand(frequency_hz, 20.0);
    const MillsCross cross{.absorption_dbpm = sand.absorption_dbpm, .quality = 4.0};
    const echo::Image image = cross.receive(seabed, {}, sand.backscatter, sines);
    for (std::size_t b = 0; b < sines.size(); ++b) {
      const double sine = double(sines[b]), null = 1.0 / cross.length_in_waves();
      const Tone tone{
          cross.source_level_db, cross.pulse_length_s,
          [&](double forward, double starboard, double) { return cross.two_way_power(forward, starboard, sine); },
          null};
      const auto sample_at = [&](double sine_from_nadir) {  // whose pulse has its middle there
        const double two_way_s = 40.0 / kSpeed_mps / std::sqrt(1.0 - sine_from_nadir * sine_from_nadir);
        return static_cast<int>(std::lround((two_way_s + 0.5 * cross.pulse_length_s) / cross.sample_period_s));
      };
      const int axis = sample_at(sine), first = sample_at(std::max(0.0, sine - null)) - 2;
      double received = 0.0, expected = 0.0, received_at_axis = 0.0, expected_at_axis = 0.0;
      for (int k = first; k <= sample_at(sine + null) + 2; ++k) {
        const double p2 = double(image.row(int(b))[k].real());
        const double integral = mean_square_upa2(sand, tone, k * cross.sample_period_s);
        received += p2, expected += integral;
        if (std::abs(k - axis) <= 6) received_at_axis += p2, expected_at_axis += integral;
      }
      INFO(frequency_hz << " Hz, " << beams_deg[b] << " deg: " << db(received / expected) << " dB, at the axis "
                        << db(received_at_axis / expected_at_axis) << " dB");
      CHECK(std::abs(db(received / expected)) < 0.5);
      CHECK(std::abs(db(received_at_axis / expected_at_axis)) < 0.5);
    }
  }
}

TEST_CASE("side lobes give the nadir's arc in every beam, at the level of the integral") {
  // Beams of a uniform line from 25 to 60 degrees during the first pulse from below: through side lobes of -25 to
  // -40 dB, as mean over beams, for a single beam may stand in a null. Before that there is silence.
  trace::Scene seabed = level_seabed(-20.0);
  const LevelSeabed sand = medium_sand(300e3, 20.0);
  const MillsCross cross{.absorption_dbpm = sand.absorption_dbpm, .quality = 4.0};
  std::vector<float> sines;
  for (double deg = 25.0; deg < 60.5; deg += 2.5) sines.push_back(static_cast<float>(std::sin(deg * kDeg)));
  sines.push_back(0.0F);
  const echo::Image image = cross.receive(seabed, {}, sand.backscatter, sines);
  const int first = static_cast<int>(std::ceil(40.0 / kSpeed_mps / cross.sample_period_s)), pulse = 4;
  double arc = 0.0, expected = 0.0, gap = 0.0, silence = 0.0;
  for (std::size_t b = 0; b + 1 < sines.size(); ++b) {
    const double sine = double(sines[b]);
    const Tone tone{
        cross.source_level_db, cross.pulse_length_s,
        [&](double forward, double starboard, double) { return cross.two_way_power(forward, starboard, sine); },
        1.0 / cross.length_in_waves()};
    for (int k = first; k < first + pulse; ++k) {
      arc += double(image.row(int(b))[k].real());
      expected += mean_square_upa2(sand, tone, k * cross.sample_period_s);
    }
    // Between the arc and the beam's own bottom, at 21.2 m (25 degrees: 22.1 m), the same beams receive less.
    const int later = static_cast<int>(42.4 / kSpeed_mps / cross.sample_period_s);
    for (int k = later; k < later + pulse; ++k) gap += double(image.row(int(b))[k].real());
    for (int k = 0; k < first - 2; ++k) silence += double(image.row(int(b))[k].real());
  }
  CHECK_THAT(db(arc / expected), WithinAbs(0.0, 0.5));
  CHECK(db(arc / gap) > 3.0);
  CHECK(silence < 1e-9 * arc);
}

TEST_CASE("a sidescan's range of equal signal and noise is the sonar equation's") {
  // SNR 0 dB by EL = NL + 10 log10(1 / tau) - DI. Signal and noise as the head records them together, less the noise,
  // which is measured where nothing answers; speckle off. 130 samples to 5 m: the noise's mean is good to 0.4 dB,
  // where 5 % of the range is 2 dB and more.
  trace::Scene seabed = level_seabed(-22.0);
  for (const auto& [frequency_hz, source_level_db] : {std::pair{100e3, 166.0}, {300e3, 172.0}, {900e3, 196.0}}) {
    SidescanConfig config = sidescan_of(frequency_hz);
    config.effects.speckle = false;
    config.effects.noise = true;
    SidescanChannel& channel = config.channels[0];
    channel.source_level_db = source_level_db;
    const auto both = sidescan_ping(config, seabed, {0.0, 0.0, -12.0});
    channel.source_level_db = -300.0;
    const auto noise = sidescan_ping(config, seabed, {0.0, 0.0, -12.0}, 1);
    channel.source_level_db = source_level_db;
    const double floor = power_sum(noise, 1, {0, noise.amplitude_upa.cols()}) / noise.amplitude_upa.cols();
    double found_m = 0.0;  // the first range from which on the mean over 5 m is below twice the floor
    for (double range_m = 20.0; range_m < 98.0 && found_m == 0.0; range_m += 0.1) {
      const Samples about = samples_about(both, range_m, 2.5);
      if (power_sum(both, 1, about) / double(about.end - about.first) < 2.0 * floor) found_m = range_m;
    }

    const LevelSeabed sand = medium_sand(frequency_hz, 10.0);
    const Tone tone = transmission_of(channel);
    const double directivity_db =
        array::directivity_index_db(array::length_in_waves_for(channel.horizontal_beamwidth_rad),
                                    array::length_in_waves_for(channel.vertical_beamwidth_rad));
    const double noise_db =
        water::ambient_noise_level_db(frequency_hz, 0.0) + db(1.0 / channel.pulse_length_s) - directivity_db;
    double expected_m = 20.0;
    while (db(mean_square_upa2(sand, tone, expected_m / 750.0 + 0.5 * channel.pulse_length_s)) > noise_db) {
      expected_m += 0.1;
    }
    INFO(frequency_hz << " Hz: " << found_m << " m, expected " << expected_m << " m");
    CHECK(expected_m > 40.0);
    CHECK(expected_m < 95.0);
    CHECK(found_m == Approx(expected_m).epsilon(0.05));
  }
}
