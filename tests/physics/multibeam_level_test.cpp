#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "components/multibeam/arrays.h"
#include "components/multibeam/node.h"
#include "components/sonar/testing/seabed.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/water/absorption.h"
#include "tests/physics/area_integral.h"
#include "tests/physics/heads.h"

// The multibeam head through its ports, over medium sand [APL1994] in water of 10 degC and 35 psu, against the area
// integral.

using namespace ensonify;
using namespace ensonify::physics;
using Catch::WithinAbs;

namespace {

constexpr double kDepth_m = 20.0;

constexpr double kDeg = std::numbers::pi / 180.0;

struct Received {
  std::vector<msg::Ping> pings;
  MultibeamConfig config;
};

/// At rest over a level seabed, as sums of mean squares; `yaml` is set besides.
Received receive(double frequency_hz, const std::string& yaml, SimTime until) {
  World world = world_with("head");
  world.water.profile.sound_speed_mps = 1500.0;
  world.water.noise_level_db = 50.0;
  Received received;
  received.config = config_of<MultibeamNode>("frequency_hz: " + std::to_string(frequency_hz) +
                                                 "\nsample_rate_hz: 40000\nauto_range: false\nping_rate_hz: 5\n" + yaml,
                                             world, "head");
  NodeUnderTest<MultibeamNode> head(received.config);
  give_course(head, {}, until);
  head.give("tile", tile_of(256.0, 1.0, [](double, double) { return -kDepth_m; }));
  received.pings = head.step_until<msg::Ping>("ping", until);
  return received;
}

/// The head over medium sand, as its levels should be.
class Theory {
 public:
  explicit Theory(const MultibeamConfig& config)
      : config_(config),
        sand_{kDepth_m, water::absorption_dbpm(config.frequency_hz, {.depth_m = 0.5 * kDepth_m}), 1500.0,
              seabed::law_of(*seabed::sediment_of("medium sand"), config.frequency_hz, 1500.0)},
        line_(ArrayDesign(config).receive),
        transmit_(ArrayDesign(config).transmit) {
    line_.whole.element_length_m = 0.0;  // the head's elements receive alike in all directions before its face
  }

  /// What a beam receives: a tone, seen by the transmit line and by the beam.
  Tone tone(double sin_beam) const {
    const auto receive = std::make_shared<array::PatternTable>(line_.whole, line_.wavelength_m, sin_beam);
    const auto transmit = std::make_shared<array::PatternTable>(transmit_, line_.wavelength_m);
    return {config_.source_level_db, config_.pulse_length_s,
            [receive, transmit](double forward, double starboard, double) {
              return double(transmit->power(forward)) * double(receive->power(starboard));
            },
            line_.wavelength_m / std::max(transmit_.length_m(), line_.whole.length_m())};
  }
  double mean_square_upa2(const Tone& tone, double time_s) const {
    return physics::mean_square_upa2(sand_, tone, time_s);
  }
  /// To the first null of the shaded line, as a sine.
  double null() const { return array::first_null(line_.whole, line_.wavelength_m); }
  /// When the pulse's middle returns from the seabed in this direction.
  double time_s(double sine) const {
    return kDepth_m / std::sqrt(1.0 - sine * sine) / 750.0 + 0.5 * config_.pulse_length_s;
  }
  /// NL + 10 log10(1 / tau) - DI: of a shaded line with elements half a wave apart, which receives nothing behind it.
  double noise_upa2() const {
    double sum = 0.0, squares = 0.0;
    for (const double w : line_.whole.weights) sum += w, squares += w * w;
    return 0.5 * std::pow(10.0, 0.1 * 50.0) / config_.pulse_length_s * squares / (sum * sum);
  }

 private:
  MultibeamConfig config_;
  LevelSeabed sand_;
  ReceiveLine line_;
  array::LineArray transmit_;
};

double power(const msg::Ping& ping, std::size_t beam, std::size_t sample) {
  return std::pow(double(ping.amplitude_upa(beam, sample)), 2);
}

std::size_t sample_at(const msg::Ping& ping, double time_s) {
  return static_cast<std::size_t>(time_s / double(ping.sample_period_s));
}

const std::string kSeabedOnly =
    "effects: {speckle: false, noise: false, volume: false, multipath: false, tvg: false}\n";

}  // namespace

TEST_CASE("multibeam head: level seabed gives the area integral, 0-70 deg, 100-900 kHz") {
  // Over the echo between the first nulls. Rays of reference quality leave less than 0.1 dB.
  for (const double frequency_hz : {100e3, 200e3, 300e3, 450e3, 900e3}) {
    const Received received =
        receive(frequency_hz, "beams: 15\nswath_deg: 140\nquality: 4\nrange_m: 90\n" + kSeabedOnly, 190_ms);
    const msg::Ping& ping = received.pings.at(0);
    REQUIRE(ping.amplitude_upa.rows() == 15);
    const Theory theory(received.config);
    for (std::size_t beam = 0; beam < 15; ++beam) {
      const double angle_rad = double(ping.beam_angle_rad[beam]), sine = std::sin(angle_rad);
      const Tone tone = theory.tone(sine);
      double found = 0.0, expected = 0.0;
      for (std::size_t k = sample_at(ping, theory.time_s(std::max(0.0, std::abs(sine) - theory.null())));
           k <= sample_at(ping, theory.time_s(std::abs(sine) + theory.null())); ++k) {
        found += power(ping, beam, k);
        expected += theory.mean_square_upa2(tone, double(k) * double(ping.sample_period_s));
      }
      INFO(frequency_hz << " Hz, " << angle_rad / kDeg << " deg: " << db(found / expected) << " dB");
      CHECK(std::abs(db(found / expected)) < 0.5);
    }
  }
}

TEST_CASE("multibeam head: the arc is at the nadir's range, at the integral's level") {
  // Beams from 30 to 60 degrees during the first pulse from below, through the -30 dB of a shaded line; the mean over
  // beams, for one may stand in a null. Before it there is silence, after it the side lobes receive less.
  const Received received =
      receive(300e3, "beams: 49\nswath_deg: 120\nquality: 4\nrange_m: 50\n" + kSeabedOnly, 150_ms);
  const msg::Ping& ping = received.pings.at(0);
  const Theory theory(received.config);
  const std::size_t first = sample_at(ping, 2.0 * kDepth_m / 1500.0) + 1, later = sample_at(ping, 42.4 / 1500.0);
  double arc = 0.0, expected = 0.0, gap = 0.0, silence = 0.0;
  for (std::size_t beam = 0; beam < 49; ++beam) {
    const double sine = std::sin(double(ping.beam_angle_rad[beam]));
    if (std::abs(sine) < 0.499) continue;
    const Tone tone = theory.tone(sine);
    for (std::size_t k = 0; k < 4; ++k) {
      arc += power(ping, beam, first + k);
      expected += theory.mean_square_upa2(tone, double(first + k) * double(ping.sample_period_s));
      gap += power(ping, beam, later + k);
    }
    for (std::size_t k = 0; k + 2 < first; ++k) silence += power(ping, beam, k);
  }
  INFO("arc " << db(arc / expected) << " dB from the integral, " << db(arc / gap) << " dB above what follows");
  CHECK_THAT(db(arc / expected), WithinAbs(0.0, 0.5));
  CHECK(db(arc / gap) > 3.0);
  CHECK(silence < 1e-9 * arc);
}

TEST_CASE("multibeam head: range of equal signal and noise is the sonar equation's") {
  // SNR 0 dB at the beams' axes. Noise is measured where nothing is sent; of 5 beams to either side, 3 pulses and 6
  // pings there are some 180 independent draws, 0.3 dB, where 5 % of the range is 1.5 dB.
  // The source level is that by which theory has it at the stated angle.
  for (const auto& [frequency_hz, crossing_deg] : {std::pair{100e3, 50.0}, {300e3, 55.0}, {450e3, 60.0}}) {
    const auto receive_echoes = [&](double level_db, SimTime until) {
      return receive(
          frequency_hz,
          "beams: 141\nswath_deg: 140\nquality: 1\nrange_m: 75\nsource_level_db: " + std::to_string(level_db) +
              "\neffects: {speckle: false, volume: false, multipath: false, tvg: false}\n",
          until);
    };
    const Received silent = receive_echoes(-300.0, 190_ms);
    const Theory theory(silent.config);
    const double sine = std::sin(crossing_deg * kDeg);
    Tone tone = theory.tone(sine);
    tone.source_level_db = 0.0;
    const double source_level_db = db(theory.noise_upa2() / theory.mean_square_upa2(tone, theory.time_s(sine)));
    const Received both = receive_echoes(source_level_db, 1300_ms);
    REQUIRE(both.pings.size() == 6);
    double floor = 0.0;
    for (const float a : silent.pings[0].amplitude_upa.flat()) floor += double(a) * double(a);
    floor /= static_cast<double>(silent.pings[0].amplitude_upa.size());
    CHECK_THAT(db(floor / theory.noise_upa2()), WithinAbs(0.0, 0.2));

    const auto range_m = [](double deg) { return kDepth_m / std::cos(deg * kDeg); };
    double found_m = 0.0;  // of the first beam from the nadir in which the signal is below the noise
    for (int deg = 20; deg <= 68 && found_m == 0.0; ++deg) {
      double sum = 0.0;
      int count = 0;
      for (const msg::Ping& ping : both.pings) {
        for (int off = -2; off <= 2; ++off) {
          for (const int beam : {70 - deg - off, 70 + deg + off}) {
            const std::size_t axis = sample_at(ping, theory.time_s(std::sin((deg + off) * kDeg)));
            for (std::size_t k = axis - 6; k <= axis + 6; ++k, ++count) {
              sum += power(ping, static_cast<std::size_t>(beam), k);
            }
          }
        }
      }
      if (sum / count < 2.0 * floor) found_m = range_m(deg);
    }
    const double expected_m = range_m(crossing_deg);
    INFO(frequency_hz << " Hz: " << found_m << " m, expected " << expected_m << " m");
    CHECK(found_m == Approx(expected_m).epsilon(0.05));
  }
}
