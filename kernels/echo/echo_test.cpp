#include "kernels/echo/echo.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/array/line.h"
#include "kernels/echo/allocations.h"
#include "kernels/seabed/lambert.h"

using namespace ensonify;
using namespace ensonify::echo;
using frames::Vec3;

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kDepth = 20.0, kMu = -25.0;
static const frames::HeadPose kLevel{};

/// A typical head: SL 220 dB, 100 us, 1 x 1 deg, 0.07 dB/m, 20 m, Lambert -25 dB.
static Sonar example() {
  Sonar sonar;
  sonar.transmit_length_in_waves = sonar.receive_length_in_waves = array::length_in_waves_for(1.0 * kDeg);
  return sonar;
}

struct Met {
  std::vector<trace::Ray> rays;
  std::vector<trace::Hit> hits;
  std::vector<float> backscatter;
  Transmission at(std::uint64_t ping) const { return {ping, rays, hits, backscatter}; }
};

/// Rays on a flat seabed below a level head, met in closed form.
static Met flat_seabed(const Sonar& sonar, std::uint64_t ping, int along = 24, int across = 1024) {
  Met met;
  trace::Fan({.transmit_length_in_waves = sonar.transmit_length_in_waves,
              .half_swath_rad = 75 * kDeg,
              .along = along,
              .across = across})
      .fill({9, "rays"}, ping, met.rays);
  for (const auto& ray : met.rays) {
    const Vec3 enu = kLevel.enu_from_head * ray.direction_head.cast<double>();
    const double range = kDepth / -enu.z();
    met.hits.push_back({range * enu, {0, 0, 1}, float(range), float(-enu.z()), 0});
    met.backscatter.push_back(float(seabed::lambert_backscatter(kMu, -enu.z())));
  }
  return met;
}

static double energy(std::span<const std::complex<float>> row, double period_s) {
  double sum = 0;
  for (const auto p : row) sum += std::norm(p);
  return sum * period_s;
}

/// Mean echo energy (dB re uPa^2 s) at a beam angle over pings and a few beams about it.
static double mean_energy_db(double beam_deg, int pings, int along, int across, double period_s) {
  const Sonar sonar = example();
  std::vector<float> beams;
  for (int i = -2; i <= 2; ++i) beams.push_back(float(std::sin((beam_deg + 1.5 * i) * kDeg)));
  const Sampling sampling{20e-3, period_s, int(60e-3 / period_s)};
  const std::vector<frames::HeadPose> rest{kLevel};
  Workspace workspace;
  Image image;
  double relative = 0;
  for (int ping = 0; ping < pings; ++ping) {
    const Met met = flat_seabed(sonar, ping, along, across);
    accumulate(sonar, beams, sampling, met.at(ping), {0, 1, rest}, {5, "phase"}, workspace, image);
    for (int i = 0; i < 5; ++i) {
      // Beam limited: A = R (lambda/L_T) R (lambda/L_R) / cos^2, lasting for the pulse.
      const double beta = (beam_deg + 1.5 * (i - 2)) * kDeg, R = kDepth / std::cos(beta);
      const double area =
          R * R / (sonar.transmit_length_in_waves * sonar.receive_length_in_waves) / std::pow(std::cos(beta), 2);
      const double db = sonar.source_level_db - 40 * std::log10(R) - 2 * sonar.absorption_dbpm * R +
                        seabed::lambert_strength_db(kMu, std::cos(beta)) + 10 * std::log10(area * sonar.pulse_length_s);
      relative += energy(image.row(i), period_s) / std::pow(10, 0.1 * db);
    }
  }
  return 10 * std::log10(relative / (5 * pings));
}

TEST_CASE("echo energy on a flat Lambert seabed meets the closed form") {
  // A beam's footprint at 0, 30, 45, 60 deg spans about 1, 4, 10, 32 pulses, so the energy of one ping has a relative
  // sd of at most 1, 1/2, 1/3, 1/6. Five beams (about 4 independent ones) and these numbers of pings: sd of the
  // mean 3.2 %, 0.14 dB, or less. The formula is exact to 0.06 dB; patterns cut at 8 and 6 lambda/L lose 0.05 and 0.07
  // dB. The limit is 3 sd and these.
  const std::pair<double, int> beams_and_pings[] = {{0, 240}, {30, 60}, {45, 60}, {60, 60}};
  for (const auto& [beam_deg, pings] : beams_and_pings) {
    INFO("beam at " << beam_deg << " deg");
    CHECK(mean_energy_db(beam_deg, pings, 24, 1024, 25e-6) == Approx(-0.12).margin(0.45));
  }
}

TEST_CASE("the level depends neither on the number of rays nor on the sample rate") {
  const double level = mean_energy_db(45, 60, 24, 1024, 25e-6);
  CHECK(mean_energy_db(45, 60, 48, 2048, 25e-6) == Approx(level).margin(0.3));    // both sd 0.07 dB
  CHECK(mean_energy_db(45, 60, 24, 1024, 12.5e-6) == Approx(level).margin(0.1));  // the same rays
}

static Met one_scatterer(const Vec3& place) {
  const Vec3 head = kLevel.enu_from_head.conjugate() * place.normalized();
  Met met;
  met.rays.push_back({head.cast<float>(), 1e-3F});
  met.hits.push_back({place, {0, 0, 1}, float(place.norm()), 0.5F, 0});
  met.backscatter.push_back(0.01F);
  return met;
}

TEST_CASE("one ray brings back its sonar equation for one pulse at its time") {
  const Sonar sonar = example();
  const Vec3 place(15.0, 0.0, -20.0);  // starboard of a head that looks north: 25 m
  const std::vector<float> beams{0.6F, 0.0F};
  const std::vector<frames::HeadPose> rest{kLevel};
  Workspace workspace;
  Image image;
  const Met met = one_scatterer(place);
  accumulate(sonar, beams, {0.0, 20e-6, 3000}, met.at(0), {0, 1, rest}, {1, "p"}, workspace, image);
  const double want_db = 220 + 10 * std::log10(0.01 * 1e-3 / (25.0 * 25.0 * 0.5)) - 2 * 0.07 * 25;
  const auto row = image.row(0);
  const int first = int(std::ceil(2 * 25 / 1500.0 / 20e-6));
  for (int k = 0; k < 3000; ++k) {
    if (k < first || k >= first + 5) {
      REQUIRE(row[k] == std::complex<float>{});
    } else {
      REQUIRE(10 * std::log10(std::norm(row[k])) == Approx(want_db).margin(1e-3));
    }
  }
  CHECK(energy(image.row(1), 1) == 0.0);  // 0.6 is beyond the reach of the beam at 0
}

TEST_CASE("the receive pattern follows the receiver's attitude at arrival, the time its place") {
  Sonar sonar = example();
  const Vec3 place(0.0, 0.0, -30.0);  // 40 ms
  const Met met = one_scatterer(place);
  // By 40 ms the head has rolled so that the nadir lies half a power beamwidth off, and risen by 0.3 m.
  const double roll = std::asin(array::half_power_half_width(sonar.receive_length_in_waves));
  std::vector<frames::HeadPose> track{kLevel, kLevel};
  track[1].enu_from_head = enu_from_body(frames::Attitude{0, 0, 2 * roll});
  track[1].position_enu_m.z() = 0.6;
  const std::vector<float> beams{0.0F};
  Workspace workspace;
  Image still, moving;
  const std::vector<frames::HeadPose> rest{kLevel};
  const Sampling sampling{0.0, 10e-6, 6000};
  accumulate(sonar, beams, sampling, met.at(0), {0, 1, rest}, {1, "p"}, workspace, still);
  accumulate(sonar, beams, sampling, met.at(0), {0.0, 80e-3, track}, {1, "p"}, workspace, moving);
  const auto first = [](const Image& image) {
    int k = 0;
    while (image.row(0)[k] == std::complex<float>{}) ++k;
    return k;
  };
  CHECK(first(moving) - first(still) == 20);  // 0.3 m further back: 200 us
  const double change_db =
      10 * std::log10(std::norm(moving.row(0)[first(moving) + 2]) / std::norm(still.row(0)[first(still) + 2]));
  CHECK(change_db == Approx(-3.0103 - 20 * std::log10(30.3 / 30.0) - 0.07 * 0.3).margin(0.02));
}

TEST_CASE("the speckle of a seabed is fully developed") {
  // At 50 deg some 30 rays share a cell. |p|^2 is exponential: cv 1, here from about 40 x 50 independent samples (sd
  // 3-5 %).
  const Sonar sonar = example();
  const std::vector<float> beams{float(std::sin(50 * kDeg))};
  const std::vector<frames::HeadPose> rest{kLevel};
  Workspace workspace;
  Image image;
  const double t = 2 * kDepth / std::cos(50 * kDeg) / 1500;
  double n = 0, sum = 0, squares = 0;
  for (int ping = 0; ping < 400; ++ping) {
    const Met met = flat_seabed(sonar, ping);
    accumulate(sonar, beams, {t - 150e-6, 100e-6, 4}, met.at(ping), {0, 1, rest}, {5, "phase"}, workspace, image);
    for (const auto p : image.row(0)) n += 1, sum += std::norm(p), squares += std::norm(p) * std::norm(p);
  }
  const double cv = std::sqrt(squares / n - sum * sum / n / n) / (sum / n);
  CHECK(cv == Approx(1.0).margin(
                  0.15));  // 1600 samples: sd of cv about 0.04; M scatterers of unequal strength lower or raise it
}

TEST_CASE("threads change no bit, and a ping after the first allocates nothing") {
  const Sonar sonar = example();
  const Met met = flat_seabed(sonar, 0);
  std::vector<float> beams;
  for (const float angle : array::equiangular_beams_rad(65 * kDeg, 256)) beams.push_back(std::sin(angle));
  const std::vector<frames::HeadPose> rest{kLevel};
  Workspace workspace;
  Image one, two;
  const auto run = [&](Image& image, std::uint64_t ping, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    accumulate(sonar, beams, {0, 50e-6, 2000}, met.at(ping), {0, 1, rest}, {5, "phase"}, workspace, image);
  };
  run(one, 7, 1);
  run(two, 7, 2);
  CHECK(one.envelope_upa == two.envelope_upa);
  CHECK(energy(one.row(128), 1) > 0);

  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
  const long before = allocations();
  for (std::uint64_t ping = 8; ping < 18; ++ping) {
    accumulate(sonar, beams, {0, 50e-6, 2000}, met.at(ping), {0, 1, rest}, {5, "phase"}, workspace, one);
  }
  CHECK(allocations() - before == 0);
}
