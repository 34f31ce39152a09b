#include "kernels/acoustics/echo/beam_rows.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>

#include "kernels/acoustics/echo/line_receiver.h"
#include "kernels/base/random/stream.h"

using namespace ensonify;
using namespace ensonify::echo;

TEST_CASE("a beam is the sum of its six points, sample by sample, on grids of any width") {
  const random::Stream stream(1, "grid");
  for (const std::size_t stride : {std::size_t{12}, std::size_t{18}, std::size_t{251}}) {
    std::vector<std::complex<float>> grid(stride * BeamRows::kSamples);
    random::add_gaussian(stream, stride, 0, 1.0F, grid);
    BeamRows rows;
    rows.set(grid.data(), stride);
    const Spreading::Taps taps = Spreading().taps(0.3F);
    for (const std::size_t first : {std::size_t{0}, std::size_t{3}, stride - 6}) {
      BeamRows::Row row;
      rows.read(first, taps, row);
      for (std::size_t k = 0; k < BeamRows::kSamples; ++k) {
        std::complex<float> want;
        for (std::size_t i = 0; i < 6; ++i)
          want += taps[static_cast<Eigen::Index>(2 * i)] * grid[k * stride + first + i];
        REQUIRE(std::abs(std::complex<float>(row[2 * k], row[2 * k + 1]) - want) < 1e-5F);
      }
    }
  }
}

TEST_CASE("a whole line's amplitudes alone are those of its image, which its halves do not feel") {
  const random::Stream ambient(1, "ambient");
  const LineReceiver receiver({24, 0.5});
  std::vector<float> lower(24, 0.0F), upper(24, 0.0F);
  for (std::size_t m = 0; m < 24; ++m) (m < 12 ? lower : upper)[m] = 1.0F / 24.0F;
  const std::vector<WantedImage> wanted{WantedImage(std::vector<float>(24, 1.0F / 24.0F)), WantedImage(lower),
                                        WantedImage(upper)};
  const SampledPulse pulse(rectangular_pulse(100e-6), 50e-6);
  const Sampling sampling{0.0, 50e-6, 75};  // the last block is not full
  const Background noise{3, 100.0, &ambient, 0.0, nullptr, {}, nullptr};
  const std::vector<float> beams{-0.5F, 0.0F, 0.1F};
  LineReceiver::Memory memory;
  std::vector<Image> images(3), halves(3);
  std::vector<float> amplitude(3 * 75), want;
  for (const Background& background : {noise, Background{}}) {  // silence too
    receiver.form({{}, pulse, sampling, background}, beams, wanted, images, memory);
    receiver.form({{}, pulse, sampling, background, nullptr, amplitude}, beams, wanted, halves, memory);
    amplitude_upa(images[0], want);
    CHECK(amplitude == want);
    CHECK(halves[0].beams == 3);
    CHECK(halves[0].samples == 75);
    CHECK(halves[1].envelope_upa == images[1].envelope_upa);
    CHECK(halves[2].envelope_upa == images[2].envelope_upa);
  }
  // Without halves the image is there as well.
  std::vector<Image> alone(1);
  receiver.form({{}, pulse, sampling, noise, nullptr, amplitude}, beams, std::span(wanted).first(1), alone, memory);
  amplitude_upa(alone[0], want);
  CHECK(amplitude == want);
}
