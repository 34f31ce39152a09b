#include "kernels/detect/bottom.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/array/line.h"
#include "kernels/echo/echo.h"
#include "kernels/echo/noise.h"
#include "kernels/seabed/lambert.h"

using namespace ensonify;
using namespace ensonify::detect;
using frames::Vec3;

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kDepth = 20.0;

/// A head at rest over a flat Lambert seabed, 1 x 1 deg, 100 us; noise of 50 dB.
struct Survey {
  echo::Sonar sonar;
  echo::Sampling sampling{20e-3, 40e-6, 1500};
  std::vector<float> sin_beams;
  double noise_db = 50.0;

  Survey() {
    sonar.transmit_length_in_waves = sonar.receive_length_in_waves = array::length_in_waves_for(1.0 * kDeg);
    for (const float angle : array::equiangular_beams_rad(65 * kDeg, 131)) sin_beams.push_back(std::sin(angle));
  }

  std::vector<Detection> ping(std::uint64_t number) {
    const frames::HeadPose level{};
    std::vector<trace::Ray> rays;
    trace::Fan({.transmit_length_in_waves = sonar.transmit_length_in_waves, .half_swath_rad = 72 * kDeg})
        .fill({9, "rays"}, number, rays);
    std::vector<trace::Hit> hits;
    std::vector<float> backscatter;
    for (const auto& ray : rays) {
      const Vec3 enu = level.enu_from_head * ray.direction_head.cast<double>();
      const double range = kDepth / -enu.z();
      hits.push_back({range * enu, {0, 0, 1}, float(range), float(-enu.z()), 0});
      backscatter.push_back(float(seabed::lambert_backscatter(-25, -enu.z())));
    }
    const std::vector<frames::HeadPose> rest{level};
    accumulate(sonar, sin_beams, sampling, {number, rays, hits, backscatter}, {0, 1, rest}, {5, "phase"}, workspace,
               image);
    add_noise(noise_db, number, {6, "noise"}, image);
    amplitude_upa(image, amplitude);
    std::vector<Detection> detections;
    detect_bottom(settings(), sin_beams, amplitudes(), detections);
    return detections;
  }

  Settings settings() const {
    return {.pulse_length_s = sonar.pulse_length_s,
            .absorption_dbpm = sonar.absorption_dbpm,
            .receive_length_in_waves = sonar.receive_length_in_waves};
  }
  Amplitudes amplitudes() const { return {image.beams, image.samples, sampling.start_s, sampling.period_s, amplitude}; }

  echo::Workspace workspace;
  echo::Image image;
  std::vector<float> amplitude;
};

TEST_CASE("the depth of a flat seabed is unbiased to 65 degrees, and its backscatter is right") {
  Survey survey;
  const int pings = 60;
  struct Sums {
    double n = 0, depth = 0, square = 0, predicted = 0, strength = 0;
  };
  std::vector<Sums> by_angle(7);  // |beam| rounded to 10 deg; 60 holds 55..65
  for (int ping = 0; ping < pings; ++ping) {
    const auto detections = survey.ping(ping);
    for (std::size_t beam = 0; beam < detections.size(); ++beam) {
      const Detection& d = detections[beam];
      REQUIRE(d.valid);
      const double sine = survey.sin_beams[beam], cosine = std::sqrt(1 - sine * sine);
      const double R = 0.5 * 1500 * d.two_way_s;
      const double angle_deg = std::asin(std::abs(sine)) / kDeg;
      Sums& sums = by_angle[std::min<std::size_t>(6, std::size_t(std::lround(angle_deg / 10)))];
      sums.n += 1;
      sums.depth += R * cosine - kDepth;
      sums.square += std::pow(R * cosine - kDepth, 2);
      sums.predicted += std::pow(10, -2 * d.quality);
      const double area =
          beam_area_m2(R, sine, survey.sonar.transmit_length_in_waves, survey.sonar.receive_length_in_waves);
      sums.strength += std::pow(10, 0.1 * (d.echo_energy_db - 10 * std::log10(100e-6) - 220 + 40 * std::log10(R) +
                                           2 * 0.07 * R - 10 * std::log10(area) + 25 - 20 * std::log10(cosine)));
    }
  }
  for (std::size_t i = 0; i < by_angle.size(); ++i) {
    const Sums& sums = by_angle[i];
    const double bias = sums.depth / sums.n / kDepth, sd = std::sqrt(sums.square / sums.n) / kDepth;
    const double predicted = std::sqrt(sums.predicted / sums.n), strength_db = 10 * std::log10(sums.strength / sums.n);
    INFO("about " << 10 * i << " deg: bias " << 100 * bias << " %, sd " << 100 * sd << " %, predicted "
                  << 100 * predicted << " %, strength off by " << strength_db << " dB");
    // 600 beams or more (1320 / 2 in the first) of sd up to 0.6 %, neighbours half correlated: sd of the mean under
    // 0.04 %.
    CHECK(std::abs(bias) < 0.002);
    CHECK(sd < 0.01);
    CHECK(predicted / sd > 0.4);
    CHECK(predicted / sd < 2.5);
    // The window cuts some 5 % of the pattern's skirts (0.2 dB), the fan and the beams' reach another 0.12 dB.
    CHECK(strength_db == Approx(-0.3).margin(0.35));
  }
}

TEST_CASE("a silent sea and a source of -200 dB give no detection") {
  Survey survey;
  survey.sonar.source_level_db = -200;
  for (int ping = 0; ping < 20; ++ping) {
    for (const Detection& d : survey.ping(ping)) REQUIRE_FALSE(d.valid);
  }
  survey.sonar.source_level_db = -std::numeric_limits<double>::infinity();
  survey.noise_db = -std::numeric_limits<double>::infinity();
  for (const Detection& d : survey.ping(0)) REQUIRE_FALSE(d.valid);
}

TEST_CASE("noise passes the gate as often as it should") {
  // One sample per pulse, 250 samples: a beam alarms with probability 1 - (1 - exp(-G))^250. The noise estimate (256
  // samples, sd 9 % of the power) spreads G; averaged over that spread at 9 dB (G = 7.94) the rate is 0.09 to 0.14 for
  // 20000 beams (sd 0.002).
  echo::Image image{200, 250, std::vector<std::complex<float>>(200 * 250)};
  std::vector<float> amplitude, beams(200, 0.0F);
  std::vector<Detection> detections;
  int alarms = 0;
  for (std::uint64_t ping = 0; ping < 100; ++ping) {
    std::fill(image.envelope_upa.begin(), image.envelope_upa.end(), std::complex<float>{});
    echo::add_noise(30, ping, {1, "noise"}, image);
    amplitude_upa(image, amplitude);
    detect_bottom({.pulse_length_s = 50e-6, .gate_db = 9}, beams, {200, 250, 20e-3, 50e-6, amplitude}, detections);
    for (const Detection& d : detections) alarms += d.snr_db >= 9;
  }
  const double plain = 1 - std::pow(1 - std::exp(-std::pow(10, 0.9)), 250);  // 0.085
  CHECK(alarms / 20000.0 > plain);
  CHECK(alarms / 20000.0 < 1.6 * plain);
}

TEST_CASE("a lone pulse is found at its start, to a fraction of a sample") {
  std::vector<float> amplitude(1000, 1.0F);  // a steady noise of 0 dB
  for (int k = 400; k < 404; ++k) amplitude[std::size_t(k)] = 100.0F;
  std::vector<Detection> detections;
  const std::vector<float> nadir{0.0F};
  detect_bottom({.pulse_length_s = 200e-6}, nadir, {1, 1000, 0.01, 50e-6, amplitude}, detections);
  REQUIRE(detections[0].valid);
  // Samples 400..403 cover a pulse that began between 399 and 400.
  CHECK(detections[0].two_way_s == Approx(0.01 + 399.5 * 50e-6).margin(2e-6));
  CHECK(detections[0].echo_energy_db == Approx(10 * std::log10(1e4 * 200e-6)).margin(0.05));
  detect_bottom({.pulse_length_s = 200e-6, .search_end_s = 0.02}, nadir, {1, 1000, 0.01, 50e-6, amplitude}, detections);
  CHECK_FALSE(detections[0].valid);  // it comes at 0.03
}

TEST_CASE("threads change no bit of a detection") {
  Survey survey;
  survey.ping(1);
  const auto detect_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<Detection> detections;
    detect_bottom(survey.settings(), survey.sin_beams, survey.amplitudes(), detections);
    return detections;
  };
  const auto one = detect_with(1), two = detect_with(2);
  for (std::size_t i = 0; i < one.size(); ++i) REQUIRE(one[i].two_way_s == two[i].two_way_s);
}
