#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "components/multibeam/arrays.h"
#include "components/multibeam/node.h"
#include "components/runtime/head/test_seabed.h"
#include "kernels/array/line.h"
#include "kernels/array/pattern_table.h"
#include "kernels/water/absorption.h"
#include "tests/physics/area_integral.h"
#include "tests/physics/heads.h"

// The multibeam head through its ports, over medium sand [APL1994] in water of 10 degC and 35 psu, against the area
// integral.

using namespace ensonify;
using namespace ensonify::physics;

namespace {

constexpr double kDepth_m = 20.0;

struct Heard {
  msg::Ping ping;
  MultibeamConfig config;
};

/// One ping, as sums of mean squares, of 14 beams 10 degrees apart.
Heard hear(double frequency_hz) {
  Scenario world = world_with("head");
  world.water.profile.sound_speed_mps = 1500.0;
  const std::string yaml = "frequency_hz: " + std::to_string(frequency_hz) +
                           "\nbeams: 14\nswath_deg: 130\nsample_rate_hz: 40000\nquality: 4\nauto_range: false\n"
                           "range_m: 60\nping_rate_hz: 5\n"
                           "effects: {speckle: false, noise: false, volume: false, multipath: false, tvg: false}\n";
  Heard heard;
  heard.config = config_of<MultibeamNode>(yaml, world, "head");
  NodeUnderTest<MultibeamNode> head(heard.config);
  give_course(head, {}, 150_ms);
  head.give("tile", tile_of(256.0, 1.0, [](double, double) { return -kDepth_m; }));
  heard.ping = head.step_until<msg::Ping>("ping", 150_ms).at(0);
  return heard;
}

}  // namespace

TEST_CASE("multibeam head: the mean level of a level seabed is that of the area integral, 5-65 degrees, 100-900 kHz") {
  // Over the echo between the first nulls. Rays of reference quality leave less than 0.1 dB.
  for (const double frequency_hz : {100e3, 200e3, 300e3, 450e3, 900e3}) {
    const Heard all = hear(frequency_hz);
    const msg::Ping& ping = all.ping;
    const MultibeamConfig& config = all.config;
    REQUIRE(ping.amplitude_upa.rows() == 14);
    const LevelSeabed sand{kDepth_m, water::absorption_dbpm(frequency_hz, {.depth_m = 0.5 * kDepth_m}), 1500.0,
                           seabed::law_of(*seabed::sediment_of("medium sand"), frequency_hz, 1500.0)};
    ReceiveLine line = receive_line(config);
    line.whole.element_length_m = 0.0;  // the head's elements hear alike in all directions before its face
    const double transmit_waves = array::length_in_waves_for(config.transmit_beamwidth_rad);
    for (std::size_t beam = 0; beam < 14; ++beam) {
      const double angle_rad = double(ping.beam_angle_rad[beam]), sine = std::sin(angle_rad);
      const array::PatternTable receive(line.whole, line.wavelength_m, sine);
      const Tone tone{config.source_level_db, config.pulse_length_s,
                      [&](double forward, double starboard, double) {
                        return array::line_power(transmit_waves, forward) * double(receive.power(starboard));
                      },
                      1.0 / transmit_waves};
      const double half_width = 1.5 / transmit_waves;  // to the first null of a shaded line, as a sine
      const auto sample_at = [&](double sine_from_nadir) {
        const double range_m = kDepth_m / std::sqrt(1.0 - sine_from_nadir * sine_from_nadir);
        return static_cast<std::size_t>((range_m / 750.0 + 0.5 * config.pulse_length_s) / double(ping.sample_period_s));
      };
      double heard = 0.0, expected = 0.0;
      for (std::size_t k = sample_at(std::max(0.0, std::abs(sine) - half_width));
           k <= sample_at(std::abs(sine) + half_width); ++k) {
        heard += std::pow(double(ping.amplitude_upa(beam, k)), 2);
        expected += mean_square_upa2(sand, tone, double(k) * double(ping.sample_period_s));
      }
      INFO(frequency_hz << " Hz, " << angle_rad * 180.0 / std::numbers::pi << " deg: " << db(heard / expected)
                        << " dB");
      CHECK(std::abs(db(heard / expected)) < 0.5);
    }
  }
}
