#include "components/sidescan/config.h"

#include <catch2/catch.hpp>

#include "components/sonar/testing/config.h"
#include "scenarios/world/testing/default_yaml.h"

using namespace ensonify;
using Catch::WithinAbs;

TEST_CASE("sidescan/default.yaml lists every parameter with its default") {
  CHECK(default_yaml_fault<SidescanConfig>("sidescan", world_with("sidescan")) == "");
}

TEST_CASE("a sidescan outside its limits is refused with place and limits") {
  CHECK(problems_of<SidescanConfig>("{channels: [{name: low, frequency_hz: 5000}]}") ==
        "head.yaml:1:39: channels[0].frequency_hz: 5000 is outside [50000, 2e+06]");
  CHECK_THAT(problems_of<SidescanConfig>("channels: []"), Catch::Contains("channels: needs at least one channel"));
  CHECK_THAT(
      problems_of<SidescanConfig>("{channels: [{name: a, frequency_hz: 100e3}, {name: a, frequency_hz: 500e3}]}"),
      Catch::Contains("is taken by another channel"));
  CHECK_THAT(
      problems_of<SidescanConfig>("{channels: [{name: a, frequency_hz: 100e3, pulse: chirp, bandwidth_hz: 1000}]}"),
      Catch::Contains("a chirp needs at least 4"));
  CHECK_THAT(problems_of<SidescanConfig>("{channels: [{name: a, frequency_hz: 100e3, bandwidth_hz: 1000}]}"),
             Catch::Contains("only a chirp sweeps"));
  CHECK(problems_of<SidescanConfig>("{channels: [{name: a, frequency_hz: 100e3, focus: sharp}]}") ==
        "head.yaml:1:51: channels[0].focus: is \"sharp\", not one of ideal, echo, fixed, off");
  CHECK(problems_of<SidescanConfig>("{channels: [{name: a, frequency_hz: 100e3, window: kaiser}]}") ==
        "head.yaml:1:52: channels[0].window: is \"kaiser\", not one of none, hann, hamming, blackman");
  CHECK_THAT(problems_of<SidescanConfig>("{channels: [{name: a, frequency_hz: 100e3, focus_m: 30}]}"),
             Catch::Contains("focus_m: is the range that focus: fixed is focused at, above 0, and 0 otherwise"));
  CHECK_THAT(problems_of<SidescanConfig>("{channels: [{name: a, frequency_hz: 100e3, focus: fixed}]}"),
             Catch::Contains("focus_m: is the range that focus: fixed is focused at, above 0, and 0 otherwise"));
  CHECK_THAT(
      problems_of<SidescanConfig>("{channels: [{name: a, frequency_hz: 100e3, pulse: chirp, pulse_length_s: 1e-2, "
                                  "bandwidth_hz: 1e4, tapered_fraction: 0.2}]}"),
      Catch::Contains("tapered_fraction: is of tones; chirps have a window"));
  CHECK_THAT(
      problems_of<SidescanConfig>("{channels: [{name: a, frequency_hz: 100e3, range_m: 1000, pulse_length_s: 1e-5}]}"),
      Catch::Contains("at most 100000 are allowed"));
}

TEST_CASE("a two-way beam width makes a line that is wider one-way") {
  auto from = ConfigReader::from_text(
      "{channels: [{name: a, frequency_hz: 100e3, horizontal_beamwidth_deg: 1, horizontal_beamwidth_is: two_way}]}",
      "head.yaml");
  const auto config = SidescanConfig::read(from, world_with("towed"), "towed");
  from.finish();
  // The half-power widths of sinc^2 and sinc^4 are 50.76 and 36.55 lambda / L degrees.
  CHECK(config.channels.at(0).horizontal_beamwidth_rad / SidescanChannel::kDegree ==
        Approx(50.76 / 36.55).epsilon(2e-4));
}

TEST_CASE("a shaded line is read, and refused where the near field is asked for") {
  const std::string channel = "{channels: [{name: a, frequency_hz: 100e3, shading: {window: hann}";
  auto from = ConfigReader::from_text(channel + "}]}", "head.yaml");
  const auto config = SidescanConfig::read(from, world_with("towed"), "towed");
  from.finish();
  CHECK(config.channels.at(0).shading.window == array::Shading::Window::kHann);
  CHECK(problems_of<SidescanConfig>(channel + ", focus: echo}]}") ==
        "head.yaml:1:53: channels[0].shading: is of lines with focus: ideal; the near field is that of a uniform line");
}

TEST_CASE("a tapered tone brings less energy") {
  auto from =
      ConfigReader::from_text("{channels: [{name: a, frequency_hz: 100e3, tapered_fraction: 0.4}]}", "head.yaml");
  const auto config = SidescanConfig::read(from, world_with("towed"), "towed");
  from.finish();
  // The square of a raised cosine has a mean of 3/8: 1 - 5/8 of the tapered fraction is left.
  CHECK(config.channels.at(0).pulse(1e-3).equivalent_length_s() == Approx(0.75e-3).epsilon(1e-3));
}

TEST_CASE("the window of a channel's chirp weighs its filter") {
  auto from = ConfigReader::from_text(
      "{channels: [{name: a, frequency_hz: 100e3, pulse: chirp, pulse_length_s: 1e-2, bandwidth_hz: 1e4, window: "
      "hann}, "
      "{name: b, frequency_hz: 100e3, pulse: chirp, pulse_length_s: 1e-2, bandwidth_hz: 1e4}]}",
      "head.yaml");
  const auto config = SidescanConfig::read(from, world_with("towed"), "towed");
  from.finish();
  // 20 dB of B T = 100, less what each window costs [Harris1978]: 1.76 and 1.34 dB.
  CHECK_THAT(config.channels.at(0).pulse(1e-2).processing_gain_db, WithinAbs(20.0 - 1.76, 0.02));
  CHECK_THAT(config.channels.at(1).pulse(1e-2).processing_gain_db, WithinAbs(20.0 - 1.34, 0.02));
}
