// The last step of a block: beams off its grid (line_grid.cpp has the others).
#include <algorithm>
#include <array>
#include <complex>

#include "kernels/acoustics/echo/line_grid.h"

namespace ensonify::echo {
namespace {

constexpr int kBlock = ByTime<GridPoint>::kBlock;
static_assert(kBlock == BeamRows::kSamples);

}  // namespace

void LineGrid::silence(int first, int samples, std::span<Image> images, const Form& form) {
  for (Image& image : images) {
    for (int beam = 0; beam < image.beams && !image.envelope_upa.empty(); ++beam)
      std::fill_n(image.row(beam).data() + first, samples, std::complex<float>{});
  }
  if (form.amplitude_upa.empty()) return;
  for (int beam = 0; beam < images[0].beams; ++beam)
    std::fill_n(form.amplitude_upa.begin() + std::ptrdiff_t{beam} * images[0].samples + first, samples, 0.0F);
}

/// A block of all beams off the grids of one or two sets of weights; of two also their sum, as its image or by its
/// amplitudes alone.
void LineGrid::read_beams(int block, int samples, std::span<const Steer> steers, std::span<const BeamRows> rows,
                          std::span<Image> images, const Form& form) {
  const auto first = static_cast<std::size_t>(block) * kBlock, count = static_cast<std::size_t>(samples);
  const auto put = [&](const BeamRows::Row& row, Image& image, std::size_t beam) {
    std::complex<float>* const out = image.row(static_cast<int>(beam)).data() + first;
    std::copy_n(row.data(), 2 * count, reinterpret_cast<float*>(out));
  };
  const auto samples_in_row = static_cast<std::size_t>(images[0].samples);
  for (std::size_t beam = 0; beam < steers.size(); ++beam) {
    alignas(64) std::array<BeamRows::Row, 2> row;
    const Steer& steer = steers[beam];
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i].read(static_cast<std::size_t>(steer.first), steer.taps, row[i]);
    if (!form.halved) {
      put(row[0], images[0], beam);
      continue;
    }
    put(row[0], images[1], beam);
    put(row[1], images[2], beam);
    add(row[0], row[1], row[0]);
    if (form.amplitude_upa.empty()) {
      put(row[0], images[0], beam);
      continue;
    }
    alignas(64) std::array<float, BeamRows::kSamples> amplitude;
    magnitudes(row[0], amplitude);
    float* const out = form.amplitude_upa.data() + beam * samples_in_row + first;
    std::copy_n(amplitude.data(), count, out);
  }
}

}  // namespace ensonify::echo
