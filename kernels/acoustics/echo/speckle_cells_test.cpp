#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "kernels/acoustics/echo/testing/found.h"
#include "kernels/acoustics/echo/testing/strip.h"
#include "kernels/base/testing/allocations.h"

using namespace ensonify;
using namespace ensonify::echo;
using Catch::WithinAbs;
using frames::Vec3;

TEST_CASE("a repeated ping repeats bit by bit") {
  CHECK(strip().echo({0.1, 0.2, 0}, 1) == strip().echo({0.1, 0.2, 0}, 1));
  CHECK(strip().echo({0.1, 0.2, 0}, 1) != strip().echo({0.1, 0.2, 0}, 2));
}

TEST_CASE("along-track, echoes decorrelate over half the transmit aperture") {
  // Scatterers at along-track sine u change their two-way phase by 2 k d u. Weighted with sinc^2(L u / lambda) that is
  // the triangle 1 - 2 d / L (van Cittert and Zernike). Each estimate is of some 9 pulses x 12 seabeds: sd 0.1 where
  // the triangle is low, 0.05 where it is 0.5. Cells with few rays take away another 3 % each.
  const double L = kLines * kWave;
  const Vec3 start(0.3, -0.2, 0.0);
  // So it is with long cells, here as long as their beam allows: a quarter of what it covers.
  for (const CellSize& size : {CellSize(0.03), CellSize::for_beam(0.03, 1 * kDeg)}) {
    CHECK_THAT(coherence(start, start + Vec3(0, L / 16, 0), 12, size), WithinAbs(0.875, 0.06));
    CHECK_THAT(coherence(start, start + Vec3(0, L / 4, 0), 12, size), WithinAbs(0.5, 0.13));
    CHECK(coherence(start, start + Vec3(0, 0.55 * L, 0), 12, size) < 0.25);
  }
}

TEST_CASE("along the range, echoes decorrelate over half a pulse's length of water") {
  // Towards the strip by dr: the windows overlap by 1 - 2 dr / (c tau) and the phase turns by 2 k dr as a whole.
  const Vec3 start(0.3, -0.2, 0.0), towards = Vec3(1, 0, -1).normalized();
  CHECK(coherence(start, start + 0.01 * towards, 12) > 0.75);  // 0.87, less the turn between 44 and 46 deg
  CHECK(coherence(start, start + 0.09 * towards, 12) < 0.25);
}

TEST_CASE("speckle is Rayleigh", "[long]") {
  // Samples one pulse apart are independent. Kolmogorov and Smirnov's test at 5 %, on N = 9 x 16 amplitudes of known
  // mean square (the mean over all): 40 of them, of which 2 are expected to fail; 6 or fewer do in 99.7 % of cases.
  std::vector<std::vector<double>> sets;
  double sum = 0.0;
  std::size_t count = 0;
  for (int set = 0; set < 40; ++set) {
    auto& powers = sets.emplace_back();
    for (int seed = 0; seed < 8; ++seed) {
      const auto echo = strip().echo({0, 0, 0}, 1000 + 8 * set + seed);
      for (std::size_t k = 0; k < echo.size(); k += 2) powers.push_back(std::norm(echo[k]));
    }
    for (const double power : powers) sum += power;
    count += powers.size();
  }
  int rejected = 0;
  double squares = 0.0;
  for (auto& powers : sets) {
    std::sort(powers.begin(), powers.end());
    double distance = 0.0;
    const double n = double(powers.size());
    for (std::size_t i = 0; i < powers.size(); ++i) {
      const double expected = 1 - std::exp(-powers[i] / (sum / double(count)));
      distance = std::max({distance, std::abs(double(i) / n - expected), std::abs(double(i + 1) / n - expected)});
      squares += powers[i] * powers[i];
    }
    rejected += distance > 1.358 / std::sqrt(n);
  }
  CHECK(rejected <= 6);
  const double mean = sum / double(count);  // scintillation index 1; 2880 samples: sd of it 4.3 %
  CHECK_THAT(squares / double(count) / (mean * mean) - 1, WithinAbs(1.0, 0.15));
}

TEST_CASE("the energy of all rays arrives, whatever the cells") {
  const frames::HeadPose pose{};
  const auto hits = strip().hits(pose);
  double want = 0.0, area = 0.0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double insonified = strip().rays[i].solid_angle_sr / hits[i].sin_grazing * 0.01;
    want += strip().source[i] * insonified;
    area += hits[i].range_m * hits[i].range_m * insonified;
  }
  for (const CellSize& size : {CellSize(0.003), CellSize(0.03), CellSize(0.5), CellSize::for_beam(0.03, 1 * kDeg)}) {
    const SpeckleCells cells(size, {1, "seabed"});
    double sum = 0.0, cross_section = 0.0;
    const auto found = scatterers_of(cells, {pose, strip().rays, hits, strip().source, strip().backscatter});
    for (const Scatterer& one : found) {
      sum += one.scattered_upa2m2;
      cross_section += one.cross_section_m2;
      REQUIRE_THAT(one.position_enu_m.z(), WithinAbs(-kDepth, 1e-9));  // on the seabed, however coarse the cell
    }
    CHECK(sum == Approx(want).epsilon(1e-5));
    CHECK(cross_section == Approx(area).epsilon(1e-5));
  }
}

TEST_CASE("contributors survive merging, and share what their cell sends") {
  // Every third ray on another sediment: 3 cm cells hold both.
  const frames::HeadPose pose{};
  const auto one = strip().hits(pose);
  auto two = one;
  for (std::size_t i = 0; i < two.size(); i += 3) two.contributor[i] = trace::sediment_contributor(4);
  const SpeckleCells cells(0.03, {1, "seabed"});
  Receivers receivers;
  receivers.set({0, 1, std::span(&pose, 1)});
  const auto arrivals = [&](const trace::Hits& hits) {
    Arrivals echoes;
    add_direct_echoes({kFrequency, 0.07}, {0, 0, 0},
                      scatterers_of(cells, {pose, strip().rays, hits, strip().source, strip().backscatter}), receivers,
                      echoes);
    return echoes;
  };
  const auto merged = arrivals(one), apart = arrivals(two);
  REQUIRE(apart.size() > 1.5 * merged.size());
  // Of each patch: the same time, and pressures that add up to the patch's.
  std::map<double, std::complex<double>> patches;
  std::size_t others = 0;
  for (const Arrival& echo : merged) patches[echo.time_s] += std::complex<double>(echo.pressure_upa);
  double largest = 0.0, left = 0.0;
  for (const auto& [time_s, pressure] : patches) largest = std::max(largest, std::abs(pressure));
  for (const Arrival& echo : apart) {
    REQUIRE(patches.contains(echo.time_s));
    patches[echo.time_s] -= std::complex<double>(echo.pressure_upa);
    others += echo.contributor == trace::sediment_contributor(4) ? 1U : 0U;
    CHECK_FALSE((echo.contributor != trace::sediment_contributor(4) && echo.contributor != one[0].contributor));
  }
  for (const auto& [time_s, pressure] : patches) left = std::max(left, std::abs(pressure));
  CHECK(left < 1e-6 * largest);
  CHECK(others > 0.5 * merged.size());
}

TEST_CASE("responses are complex Gaussians of mean square 1") {
  const frames::HeadPose pose{};
  const auto hits = strip().hits(pose);
  const SpeckleCells cells(0.02, {1, "seabed"});
  double n = 0, power = 0, square = 0;
  std::complex<double> sum;
  for (const Scatterer& one : scatterers_of(cells, {pose, strip().rays, hits, strip().source, strip().backscatter})) {
    n += 1;
    power += std::norm(one.response);
    square += std::norm(one.response) * std::norm(one.response);
    sum += std::complex<double>(one.response);
  }
  REQUIRE(n > 5000);  // sd of the mean of an exponential 1/sqrt(n) = 1.4 %, of its square's 2.2 x that of 2; 4 sd
  CHECK_THAT(power / n, WithinAbs(1.0, 0.056));
  CHECK_THAT(square / n, WithinAbs(2.0, 0.25));
  CHECK(std::abs(sum / n) < 0.056);
}

TEST_CASE("threads change no bit of the scatterers, and they allocate once") {
  const frames::HeadPose pose{};
  const auto hits = strip().hits(pose);
  const SpeckleCells cells(0.03, {1, "seabed"});
  SpeckleCells::Accumulator sum;
  const auto ping = [&](std::size_t threads) -> const Scatterers& {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    sum.clear();
    cells.add({pose, strip().rays, hits, strip().source, strip().backscatter}, sum);
    return SpeckleCells::gather(sum);
  };
  Scatterers one;
  one = ping(1);  // the next ping is in its place
  CHECK(ping(2) == one);
  const long before = allocations();
  for (int i = 0; i < 20; ++i) ping(2);
  CHECK(allocations() - before <
        20);  // on a busy machine the second thread may come late, and makes its own memory then
  CHECK_THROWS_AS(SpeckleCells(0.0, {1, "seabed"}), std::invalid_argument);
}

TEST_CASE("batches of rays make the scatterers of all rays at once, to the bit") {
  const frames::HeadPose pose{};
  auto hits = strip().hits(pose);
  for (std::size_t i = 0; i < hits.size(); i += 3) hits.contributor[i] = trace::sediment_contributor(4);
  const SpeckleCells cells(0.03, {1, "seabed"});
  const Scatterers whole = scatterers_of(cells, {pose, strip().rays, hits, strip().source, strip().backscatter});
  for (const std::size_t size : {1000U, 7777U}) {
    SpeckleCells::Accumulator sum;
    for (std::size_t first = 0; first < hits.size(); first += size) {
      trace::Rays rays;
      trace::Hits some;
      const std::size_t end = std::min(hits.size(), first + size);
      for (std::size_t i = first; i < end; ++i) rays.push_back(strip().rays[i]), some.push_back(hits[i]);
      cells.add({pose, rays, some, std::span(strip().source).subspan(first, end - first),
                 std::span(strip().backscatter).subspan(first, end - first)},
                sum);
    }
    CHECK(SpeckleCells::gather(sum) == whole);
    sum.clear();
    CHECK(SpeckleCells::gather(sum).empty());
  }
}

TEST_CASE("what a ping leaves behind changes no bit of the next one") {
  const frames::HeadPose pose{};
  const auto one = strip().hits(pose);
  auto mixed = one;
  for (std::size_t i = 0; i < mixed.size(); i += 3) mixed.contributor[i] = trace::sediment_contributor(4);
  const SpeckleCells cells(0.03, {1, "seabed"});
  const auto insonified = [&](const trace::Hits& hits) {
    return Insonification{pose, strip().rays, hits, strip().source, strip().backscatter};
  };
  const Scatterers more{Scatterer{}, Scatterer{}};
  SpeckleCells::Accumulator sum;
  for (const trace::Hits& hits : {mixed, one, mixed}) {
    sum.clear();
    cells.add(insonified(hits), sum);
    Scatterers want = scatterers_of(cells, insonified(hits));
    for (const Scatterer& body : more) want.push_back(body);
    CHECK(SpeckleCells::gather(sum, more) == want);
  }
}
