#include "kernels/echo/interference.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/echo/aperture.h"

using namespace ensonify::echo;

static const ReceiverBand kBand{300e3, 10e3, 80.0, 1500.0, 0.0};
static const Pulse kPulse = rectangular_pulse(100e-6);

static ForeignTransmission neighbour() {
  ForeignTransmission foreign;
  foreign.source_level_db = 180;
  foreign.frequency_hz = 300e3;
  foreign.bandwidth_hz = 10e3;
  foreign.duration_s = 100e-6;
  foreign.path_m = 3.0;
  return foreign;
}

static std::vector<std::complex<float>> heard(const ForeignTransmission& foreign) {
  std::vector<Arrival> arrivals;
  add_interference(std::span(&foreign, 1), kBand, kPulse, arrivals);
  ApertureReceiver receiver;
  Image image;
  const std::vector<std::span<const float>> open(1);
  receiver.form(arrivals, open, SampledPulse(kPulse, 25e-6), {0, 25e-6, 4000}, image);
  return image.envelope_upa;
}

static int first(const std::vector<std::complex<float>>& row) {
  int k = 0;
  while (k < int(row.size()) && std::norm(row[k]) == 0.0F) ++k;
  return k;
}

TEST_CASE("cross-talk appears at its slant range with its level") {
  auto foreign = neighbour();
  foreign.time_s = 40e-3;
  const auto row = heard(foreign);
  CHECK(first(row) == int(std::ceil((40e-3 + 3.0 / 1500) / 25e-6)));
  CHECK(10 * std::log10(std::norm(row[first(row)])) == Approx(180 - 20 * std::log10(3.0)).margin(0.01));
}

TEST_CASE("it drifts through the pings when the heads do not keep time") {
  // Ours every 100 ms, theirs every 101 ms: 1 ms later in every ping, 0.75 m of slant range.
  std::vector<int> places;
  for (int ping = 0; ping < 5; ++ping) {
    auto foreign = neighbour();
    foreign.time_s = 10.01e-3 + ping * (101e-3 - 100e-3);
    places.push_back(first(heard(foreign)));
  }
  for (int ping = 1; ping < 5; ++ping) CHECK(places[ping] - places[ping - 1] == 40);  // 1 ms of 25 us samples
}

TEST_CASE("a longer foreign pulse lasts longer, at one level") {
  auto foreign = neighbour();
  foreign.duration_s = 500e-6;
  const auto row = heard(foreign);
  const int start = first(row);
  for (int k = start; k < start + 20; ++k) CHECK(std::abs(row[k]) == Approx(std::abs(row[start])).epsilon(1e-5));
  CHECK(std::norm(row[start + 21]) == 0.0F);
}

TEST_CASE("only what lies in the band passes, and the rest by the rejection") {
  auto foreign = neighbour();
  CHECK(band_overlap(foreign, kBand) == Approx(1));
  foreign.frequency_hz = 305e3;  // half of it
  CHECK(band_overlap(foreign, kBand) == Approx(0.5));
  foreign.frequency_hz = 200e3;
  CHECK(10 * std::log10(band_overlap(foreign, kBand)) == Approx(-80));
  foreign.bandwidth_hz = 400e3;  // a sweep over everything
  CHECK(band_overlap(foreign, kBand) == Approx(10.0 / 400).epsilon(1e-5));
}
