#include "components/multibeam/snippets.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/multibeam/testing/survey.h"
#include "kernels/acoustics/detect/seabed_image.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

struct Images {
  std::vector<msg::Ping> pings;
  std::vector<msg::Soundings> soundings;
  std::vector<msg::Snippets> snippets;
  std::vector<msg::SeabedImage> images;
};

Images imaged(MultibeamConfig config, SimTime until) {
  config.snippets = config.image.published = true;
  NodeUnderTest<MultibeamNode> head(config);
  give_motion(head, {.speed_mps = 3.0}, until);
  head.give("tile", flat_tile(-20.0));
  return {head.step_until<msg::Ping>("ping", until), head.step_until<msg::Soundings>("soundings", until),
          head.step_until<msg::Snippets>("snippets", until), head.step_until<msg::SeabedImage>("seabed_image", until)};
}

/// Mean power of the image's samples about the beams' axes that come from an incidence within a degree, dB.
double strength_db(const std::vector<msg::SeabedImage>& images, double incidence_deg) {
  double power = 0.0;
  int n = 0;
  for (const auto& image : images) {
    for (std::size_t i = 0; i < image.beam.size(); ++i) {
      const std::size_t centre = image.offset[i] + image.centre[i];
      for (std::size_t k = centre - 2; k <= centre + 2; ++k) {
        const double time_s = static_cast<double>(image.first_sample_s[i]) +
                              static_cast<double>(k - image.offset[i]) * image.sample_period_s - 50e-6;
        const double deg = std::acos(std::min(1.0, 2.0 * 20.0 / 1500.0 / time_s)) / MultibeamConfig::kDegree;
        if (std::abs(deg - incidence_deg) > 1.0) continue;
        power += std::pow(10.0, 0.1 * static_cast<double>(image.strength_db[k])), ++n;
      }
    }
  }
  REQUIRE(n > 100);
  return 10.0 * std::log10(power / n);
}

}  // namespace

TEST_CASE("snippets are the ping's own samples about each detection, uncorrected") {
  const Images received = imaged(shallow(), 500_ms);
  REQUIRE(received.snippets.size() == received.soundings.size());
  const msg::Snippets& s = received.snippets.back();
  const msg::Ping& ping = received.pings.back();
  const msg::Soundings& soundings = received.soundings.back();
  REQUIRE(s.ping == ping.ping);
  REQUIRE(s.beam.size() == 256);
  REQUIRE(s.offset.size() == 257);
  REQUIRE(s.offset[256] == s.amplitude_upa.size());
  for (std::size_t i = 0; i < s.beam.size(); ++i) {
    const auto first =
        static_cast<std::size_t>(std::lround(static_cast<double>(s.first_sample_s[i]) / ping.sample_period_s));
    for (std::size_t k = s.offset[i]; k < s.offset[i + 1]; ++k) {
      REQUIRE(s.amplitude_upa[k] == ping.amplitude_upa(s.beam[i], first + k - s.offset[i]));
    }
    const double centre_s = static_cast<double>(s.first_sample_s[i]) + s.centre[i] * s.sample_period_s;
    REQUIRE_THAT(centre_s, WithinAbs(static_cast<double>(soundings.travel_time_s[i]), 0.51 * s.sample_period_s));
  }
}

TEST_CASE("the seabed image of a level Lambert seabed is flat where its law is assumed") {
  MultibeamConfig config = shallow();
  config.image.crossover_rad = 10.0 * MultibeamConfig::kDegree;
  const Images received = imaged(config, 2_s);
  CHECK(received.images.back().lambert_removed);
  CHECK_THAT(received.images.back().normal_incidence_range_m, WithinAbs(20.0, 0.1));
  // Lambert's law with mu = -25 dB, the oblique strength that is assumed. The assumed area is right to 0.2 dB beyond 30
  // degrees, and some 300 independent samples to 0.25 dB.
  for (const double deg : {35.0, 45.0, 55.0}) CHECK_THAT(strength_db(received.images, deg), WithinAbs(-25.0, 0.7));
}

TEST_CASE("a wrong absorption leaves the trend across the swath that theory gives") {
  MultibeamConfig config = shallow();
  const Images right = imaged(config, 1_s);
  config.gain_absorption_dbpm = 0.12;
  const Images wrong = imaged(config, 1_s);
  CHECK(wrong.images.back().absorption_dbpm == 0.12);
  for (const double deg : {20.0, 40.0, 60.0}) {
    const double range_m = 20.0 / std::cos(deg * MultibeamConfig::kDegree);
    CHECK_THAT(strength_db(wrong.images, deg) - strength_db(right.images, deg),
               WithinAbs(2.0 * 0.05 * range_m, 0.1));  // within a degree the range changes by 0.05 dB
  }
  for (const std::size_t beam : {20U, 100U, 200U}) {
    const auto strength = [&](const Images& of) {
      return static_cast<double>(of.soundings.back().backscatter_strength_db[beam]);
    };
    const double range_m = 750.0 * static_cast<double>(right.soundings.back().travel_time_s[beam]);
    CHECK_THAT(strength(wrong) - strength(right), WithinAbs(2.0 * 0.05 * range_m, 0.1));
  }
}

TEST_CASE("images that nobody asked for are no outputs") {
  NodeUnderTest<MultibeamNode> head(shallow());
  for (const auto& out : head.ports().outs()) {
    CHECK(out.port != "snippets");
    CHECK(out.port != "seabed_image");
  }
}
