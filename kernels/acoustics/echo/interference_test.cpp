#include "kernels/acoustics/echo/interference.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/echo/aperture.h"

using namespace ensonify;
using namespace ensonify::echo;
using Catch::WithinAbs;

namespace {

const ReceiverBand kBand{300e3, 1500.0, 0.0};
const Pulse kPulse = rectangular_pulse(100e-6);

InterferingTransmission neighbour() {
  InterferingTransmission interfering;
  interfering.source_enu_m = {0.0, 3.0, 0.0};
  interfering.source_level_db = 180;
  interfering.frequency_hz = 300e3;
  interfering.duration_s = 100e-6;
  return interfering;
}

Arrivals arrivals_of(const InterferingTransmission& interfering, const Pulse& pulse = kPulse) {
  const frames::HeadPose level;  // x to north, z down
  Receivers receivers;
  receivers.set({0.0, 1.0, std::span(&level, 1)});
  Arrivals arrivals;
  add_interference(std::span(&interfering, 1), kBand, pulse, receivers, arrivals);
  return arrivals;
}

std::vector<std::complex<float>> received(const InterferingTransmission& interfering) {
  const auto arrivals = arrivals_of(interfering);
  TimeIndex index;
  Image image;
  form_apertures(std::array{EchoSet{arrivals}}, 1, SampledPulse(kPulse, 25e-6), {0, 25e-6, 4000}, index, image);
  return image.envelope_upa;
}

int first(const std::vector<std::complex<float>>& row) {
  int k = 0;
  while (k < int(row.size()) && std::norm(row[k]) == 0.0F) ++k;
  return k;
}

/// A pulse of amplitude 1 and baseband frequency, at its middle, `offset_hz`; sweeps upwards.
std::complex<double> pulse_at(double t, double length_s, double sweep_hz, double offset_hz) {
  if (t < 0.0 || t >= length_s) return 0.0;
  const double u = t - 0.5 * length_s;
  return std::polar(1.0, 2 * std::numbers::pi * (offset_hz * u + 0.5 * sweep_hz / length_s * u * u));
}

struct Output {
  double energy_s = 0.0, mean_s = 0.0;
};
/// Energy of what the filter matched to a chirp, an echo of which has peak 1 at its arrival, makes of another pulse,
/// and the time of its centre of gravity: the correlation, summed directly.
Output correlate(double length_s, double sweep_hz, const InterferingTransmission& interfering) {
  const double step_s = 0.1 / sweep_hz;
  Output output;
  for (double t = -length_s; t < interfering.duration_s; t += step_s) {
    std::complex<double> sum;
    for (double s = 0.5 * step_s; s < length_s; s += step_s) {
      sum +=
          std::conj(pulse_at(s, length_s, sweep_hz, 0.0)) *
          pulse_at(t + s, interfering.duration_s, interfering.sweep_hz, interfering.frequency_hz - kBand.frequency_hz);
    }
    const double power = std::norm(sum * step_s / length_s);
    output.energy_s += power * step_s;
    output.mean_s += t * power * step_s;
  }
  output.mean_s /= output.energy_s;
  return output;
}

}  // namespace

TEST_CASE("cross-talk appears at its slant range with its level, from where it comes") {
  auto interfering = neighbour();
  interfering.time_s = 40e-3;
  const auto row = received(interfering);
  CHECK(first(row) == int(std::ceil((40e-3 + 3.0 / 1500) / 25e-6)));
  CHECK_THAT(10 * std::log10(std::norm(row[first(row)])), WithinAbs(180 - 20 * std::log10(3.0), 0.01));
  CHECK((arrivals_of(interfering)[0].direction_head - Eigen::Vector3f::UnitX()).norm() < 1e-6F);
}

TEST_CASE("it drifts through the pings when the heads do not keep time") {
  // Ours every 100 ms, theirs every 101 ms: 1 ms later in every ping, 0.75 m of slant range.
  std::vector<int> places;
  for (int ping = 0; ping < 5; ++ping) {
    auto interfering = neighbour();
    interfering.time_s = 10.01e-3 + ping * (101e-3 - 100e-3);
    places.push_back(first(received(interfering)));
  }
  for (int ping = 1; ping < 5; ++ping) CHECK(places[ping] - places[ping - 1] == 40);  // 1 ms of 25 us samples
}

TEST_CASE("a longer foreign pulse lasts longer, at one level") {
  auto interfering = neighbour();
  interfering.duration_s = 500e-6;
  const auto row = received(interfering);
  const int start = first(row);
  for (int k = start; k < start + 20; ++k) CHECK(std::abs(row[k]) == Approx(std::abs(row[start])).epsilon(1e-5));
  CHECK(std::norm(row[start + 21]) == 0.0F);
}

TEST_CASE("only what lies in the band passes, and the rest by the rejection") {
  auto interfering = neighbour();
  CHECK(through_filter(interfering, kBand, kPulse).power == Approx(1));
  interfering.frequency_hz = 305e3;  // half of it
  CHECK(through_filter(interfering, kBand, kPulse).power == Approx(0.5));
  interfering.frequency_hz = 200e3;
  CHECK(10 * std::log10(through_filter(interfering, kBand, kPulse).power) == Approx(-80));
}

TEST_CASE("a sweep is received at full strength while it passes the band") {
  auto interfering = neighbour();
  interfering.duration_s = 10e-3;
  interfering.sweep_hz = 100e3;  // 10 kHz of ours take it a tenth of its length, in its middle
  const Passed passed = through_filter(interfering, kBand, kPulse);
  CHECK(passed.power == Approx(1));
  CHECK(passed.duration_s == Approx(1e-3));
  CHECK(passed.start_s == Approx(4.5e-3));
}

TEST_CASE("behind a chirp's filter interference has the correlation's energy and time") {
  const double length_s = 2e-3, sweep_hz = 50e3;
  const Pulse chirp = compressed_chirp(length_s, sweep_hz);
  const auto compare = [&](double duration_s, double interfering_sweep_hz, double offset_hz) {
    auto interfering = neighbour();
    interfering.duration_s = duration_s;
    interfering.sweep_hz = interfering_sweep_hz;
    interfering.frequency_hz = 300e3 + offset_hz;
    const Passed passed = through_filter(interfering, kBand, chirp);
    const Output exact = correlate(length_s, sweep_hz, interfering);
    // Spectra are taken as rectangles: a tone's skirts hold 10 % beyond 1 / T of width, Fresnel's ripple moves as much.
    CHECK(passed.power * passed.duration_s == Approx(exact.energy_s).epsilon(0.15));
    CHECK_THAT(passed.start_s + 0.5 * passed.duration_s, WithinAbs(exact.mean_s, 0.02 * length_s));
  };
  compare(200e-6, 0.0, 0.0);         // a tone in the middle of the band
  compare(200e-6, 0.0, 15e3);        // a higher one comes out earlier
  compare(1e-3, 20e3, 5e3);          // another sweep, within ours
  compare(length_s, sweep_hz, 0.0);  // our own
}

TEST_CASE("a chirp like our own is compressed as an echo is") {
  auto interfering = neighbour();
  interfering.duration_s = 2e-3;
  interfering.sweep_hz = 50e3;
  const Pulse chirp = compressed_chirp(2e-3, 50e3, Window::kHamming);
  const auto arrivals = arrivals_of(interfering, chirp);
  REQUIRE(arrivals.size() == 1);
  CHECK(arrivals[0].time_s == Approx(3.0 / 1500));
  CHECK_THAT(20 * std::log10(std::abs(arrivals[0].pressure_upa)), WithinAbs(180 - 20 * std::log10(3.0), 0.1));
}

TEST_CASE("without speckle an arrival holds the mean square") {
  const frames::HeadPose level;
  Receivers receivers;
  receivers.set({0.0, 1.0, std::span(&level, 1)});
  ReceiverBand band = kBand;
  band.sum = Sum::kMeanSquare;
  const auto interfering = neighbour();
  Arrivals arrivals;
  add_interference(std::span(&interfering, 1), band, kPulse, receivers, arrivals);
  CHECK_THAT(10 * std::log10(arrivals[0].pressure_upa.real()), WithinAbs(180 - 20 * std::log10(3.0), 1e-4));
}

TEST_CASE("another sector's echoes in our band arrive as ours, at the difference of delays") {
  const Arrivals echoes{{0.02, {3.0F, 4.0F}, Eigen::Vector3f::UnitZ()}, {0.03, {1.0F, 0.0F}, Eigen::Vector3f::UnitY()}};
  InterferingTransmission other = neighbour();
  Arrivals arrivals;
  add_echoes_of(other, echoes, kBand, kPulse, arrivals);
  other.time_s = 2e-3;  // 600 periods
  add_echoes_of(other, echoes, kBand, kPulse, arrivals);
  other.frequency_hz = 330e3;
  add_echoes_of(other, echoes, kBand, kPulse, arrivals);
  REQUIRE(arrivals.size() == 6);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(arrivals[i].time_s == echoes[i].time_s);
    CHECK(arrivals[i].pressure_upa == echoes[i].pressure_upa);
    CHECK(arrivals[i].direction_head == echoes[i].direction_head);
    CHECK(arrivals[2 + i].time_s == Approx(echoes[i].time_s + 2e-3));
    CHECK(std::abs(arrivals[2 + i].pressure_upa - echoes[i].pressure_upa) < 1e-4F);
    CHECK(std::abs(arrivals[4 + i].pressure_upa) == Approx(1e-4 * std::abs(echoes[i].pressure_upa)));  // 80 dB
    CHECK((arrivals[4 + i].direction_head - 1.1F * echoes[i].direction_head).norm() < 1e-6F);
  }
}

TEST_CASE("other echoes behind a chirp's filter keep the passed energy, over its time") {
  const Pulse chirp = compressed_chirp(2e-3, 50e3);
  InterferingTransmission other = neighbour();
  other.duration_s = 200e-6;
  const Passed passed = through_filter(other, kBand, chirp);
  Arrivals echoes;
  for (int i = 0; i < 10'000; ++i) echoes.push_back({0.02, {1.0F, 0.0F}, Eigen::Vector3f::UnitZ()});
  Arrivals arrivals;
  add_echoes_of(other, echoes, kBand, chirp, arrivals);
  double energy_s = 0.0, mean_s = 0.0, last_s = -1.0;
  for (const Arrival& arrival : arrivals) {
    energy_s += static_cast<double>(std::norm(arrival.pressure_upa)) * chirp.equivalent_length_s() / 1e4;
    mean_s += (arrival.time_s - 0.02) / 1e4;
    last_s = std::max(last_s, arrival.time_s - 0.02);
  }
  // The time is cut into whole echoes, 20 us of some 2 ms.
  CHECK(energy_s == Approx(passed.power * passed.duration_s).epsilon(0.01));
  CHECK_THAT(mean_s, WithinAbs(passed.start_s + 0.5 * passed.duration_s, 2e-5));
  CHECK_THAT(last_s, WithinAbs(passed.start_s + passed.duration_s, 4e-5));
}
