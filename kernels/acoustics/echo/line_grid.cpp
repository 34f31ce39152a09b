#include "kernels/acoustics/echo/line_grid.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/trace/batch.h"
#include "kernels/base/profile/profile.h"

namespace ensonify::echo {
namespace {

constexpr int kBlock = ByTime<GridPoint>::kBlock;
constexpr int kWidth = Spreading::kWidth;
constexpr double kNegligible = 1e-16;  // of electronic to isotropic noise: float's rounding hides it
constexpr int kLeft = kWidth / 2 - 1;  // points of a tap before the one that holds the number

/// Number k of a sample draws from counter (sample << 24) + k / 2: arrays of up to 2^25 cells do not overlap.
std::uint64_t counter_of(int sample) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(sample)) << 24; }

/// Whether the first set of weights is the sum of the other two, to the bit.
bool is_sum(std::span<const std::span<const float>> weights) {
  if (weights.size() != 3) return false;
  for (std::size_t m = 0; m < weights[0].size(); ++m) {
    if (weights[0][m] != weights[1][m] + weights[2][m]) return false;
  }
  return true;
}

float component_sd(double mean_square) { return static_cast<float>(std::sqrt(0.5 * mean_square)); }

}  // namespace

LineGrid::LineGrid(const ElementLine& line)
    : line_(line),
      cells_(fft::Transform::fast_size(std::max(2 * line.elements, 2 * kWidth))),
      stride_(cells_ + kWidth),
      to_elements_(cells_, fft::Transform::Sign::kPlus),
      to_beams_(cells_, fft::Transform::Sign::kMinus),
      white_(std::abs(line.spacing_in_waves - 0.5) < 0.005) {
  if (line.elements < 1 || !(line.spacing_in_waves > 0.0)) {
    throw std::invalid_argument("a line array needs elements and a spacing above 0");
  }
  const int half = line.elements / 2;
  std::vector<float> at_distance(static_cast<std::size_t>(half) + 1);  // from the middle, in elements
  tbb::parallel_for(0, half + 1, [&](int m) {
    at_distance[static_cast<std::size_t>(m)] =
        static_cast<float>(1.0 / Spreading::transform(2.0 * std::numbers::pi * m / cells_));
  });
  for (int m = 0; m < line.elements; ++m)
    unspread_.push_back(at_distance[static_cast<std::size_t>(std::abs(m - half))]);
  for (int cell = 0; cell < cells_ && !white_; ++cell)
    isotropic_share_.push_back(static_cast<float>(std::sqrt(share_of_sphere(cell))));
}

/// Part of all directions whose sine falls into a cell, aliases included: equal solid angles are equal sines.
double LineGrid::share_of_sphere(int cell) const {
  const double width = 1.0 / (cells_ * line_.spacing_in_waves), period = 1.0 / line_.spacing_in_waves;
  double covered = 0.0;
  const int aliases = static_cast<int>(std::ceil(line_.spacing_in_waves)) + 1;
  for (int alias = -aliases; alias <= aliases; ++alias) {
    const double middle = cell_sine(cell) + alias * period;
    covered += std::max(0.0, std::min(1.0, middle + 0.5 * width) - std::max(-1.0, middle - 0.5 * width));
  }
  return 0.5 * covered;
}

double LineGrid::isotropic_power(std::span<const float> power_weights, double sin_beam) const {
  const std::size_t middle = power_weights.size() / 2;
  double power = power_weights[middle];
  if (white_) return power;
  for (std::size_t lag = 1; lag <= middle; ++lag) {
    const double turns = line_.spacing_in_waves * static_cast<double>(lag);
    power += 2.0 * static_cast<double>(power_weights[middle + lag]) * array::sinc(2.0 * turns) *
             std::cos(2.0 * std::numbers::pi * turns * sin_beam);
  }
  return std::max(0.0, power);
}

bool LineGrid::hears_electronic(const Background& background) {
  return background.electronic_upa2 > kNegligible * background.isotropic_upa2;
}

double LineGrid::cell_sine(int cell) const {
  const int signed_cell = cell < (cells_ + 1) / 2 ? cell : cell - cells_;
  return signed_cell / (cells_ * line_.spacing_in_waves);
}

void LineGrid::check(const Input& input, std::span<const std::span<const float>> weights, std::size_t images) const {
  const auto samples = static_cast<std::size_t>(std::max(input.sampling.count, 0));
  bool fits = weights.size() == images;
  for (const EchoSet& set : input.echoes) fits = fits && set.fits(1);
  for (const auto one : weights) fits = fits && one.size() == static_cast<std::size_t>(line_.elements);
  if (!fits)
    throw std::invalid_argument(
        "a line receiver needs one image per set of weights, one weight per element, one gain per arrival");
  const Background& background = input.background;
  if (!background.volume_upa2.empty() && background.volume_upa2.size() != samples * static_cast<std::size_t>(cells_)) {
    throw std::invalid_argument("volume reverberation needs one number per sample and cell of the sine grid");
  }
  if ((background.isotropic_upa2 > 0.0 && !background.isotropic) ||
      (background.electronic_upa2 > 0.0 && !background.electronic) ||
      (!background.volume_upa2.empty() && !background.volume)) {
    throw std::invalid_argument("background sound needs a stream to draw from");
  }
}

bool LineGrid::form(const Input& input, std::span<const float> sin_beams,
                    std::span<const std::span<const float>> weights, std::span<Image> images,
                    std::span<float> amplitude_upa, Memory& memory) const {
  check(input, weights, images.size());
  const SineGrid on_grid = grid();
  GridPoints{input.echoes, input.whose, input.pulse, input.sampling, on_grid}.sort(memory.points);
  memory.steer.clear();
  for (const float sine : sin_beams) {
    const SineGrid::At at = on_grid.at(sine);
    memory.steer.push_back({at.cell, spreading_.taps(at.offset)});
  }
  const bool halved = is_sum(weights);
  const Form form{halved, halved ? amplitude_upa : std::span<float>{}};
  for (Image& image : images) {
    trace::make_room(image.envelope_upa, sin_beams.size() * static_cast<std::size_t>(input.sampling.count));
    image.resize(static_cast<int>(sin_beams.size()), input.sampling.count);
  }
  if (!form.amplitude_upa.empty()) images[0].envelope_upa.clear();

  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  if (memory.threads.size() < threads) memory.threads.resize(threads);
  const auto row = static_cast<std::size_t>(stride_);
  tbb::parallel_for(std::size_t{0}, memory.threads.size(), [&](std::size_t thread) {
    Thread& own = memory.threads[thread];
    own.grid.resize(kBlock * row);
    own.elements.resize(kBlock * static_cast<std::size_t>(line_.elements));
    own.spectrum.resize(row);
    own.field.resize(row);
    own.sum.resize(row);
    own.scale.resize(static_cast<std::size_t>(line_.elements));
    const auto drawn = static_cast<std::size_t>(kBlock + input.pulse.support() - 1);
    const auto size = [&](bool received, int each) { return received ? drawn * static_cast<std::size_t>(each) : 0; };
    own.volume.resize(size(!input.background.volume_upa2.empty(), cells_));
    own.isotropic.resize(size(hears_field(input.background), cells_));
    own.noise.resize(size(hears_elements(input.background), line_.elements));
  });
  tbb::parallel_for(0, memory.points.blocks(),
                    [&](int block) { form_block(input, block, weights, form, memory, images); });
  return !form.amplitude_upa.empty();
}

/// Draws for every sample that a block's filter reaches back to: of the cells with mean square 1, of the elements with
/// that of their noise.
void LineGrid::draw(const Input& input, int block, Thread& memory) const {
  const Background& background = input.background;
  const int rows = kBlock + input.pulse.support() - 1;
  const int first = block * kBlock - input.pulse.support() + 1;
  const auto add = [&](const random::Stream& stream, double mean_square, int row_size, auto& draws) {
    const auto size = static_cast<std::size_t>(row_size);
    for (int r = 0; r < rows; ++r) {
      random::add_gaussian(stream, background.ping, counter_of(first + r), component_sd(mean_square),
                           std::span(draws).subspan(static_cast<std::size_t>(r) * size, size));
    }
  };
  for (auto* draws : {&memory.volume, &memory.isotropic, &memory.noise}) {
    std::fill(draws->begin(), draws->end(), std::complex<float>{});
  }
  if (!background.volume_upa2.empty()) add(*background.volume, 1.0, cells_, memory.volume);
  if (hears_field(background)) add(*background.isotropic, 1.0, cells_, memory.isotropic);
  if (background.isotropic_upa2 > 0.0 && white_)
    add(*background.isotropic, background.isotropic_upa2, line_.elements, memory.noise);
  if (hears_electronic(background))
    add(*background.electronic, background.electronic_upa2, line_.elements, memory.noise);
}

/// What the filter makes of draws in row r of a block: what came k samples ago is in its k-th sample.
void LineGrid::filter(const Input& input, int r, std::span<const std::complex<float>> draws,
                      std::span<std::complex<float>> sum) {
  const auto response = input.pulse.response();
  std::fill(sum.begin(), sum.end(), std::complex<float>{});
  for (std::size_t k = 0; k < response.size(); ++k) {
    const std::size_t row = static_cast<std::size_t>(r) + response.size() - 1 - k;
    const std::complex<float>* const drawn = draws.data() + row * sum.size();
    std::complex<float>* const to = sum.data();
    const float share = response[k];
    for (std::size_t i = 0; i < sum.size(); ++i) to[i] += share * drawn[i];
  }
}

/// Sound from all directions at once in one sample, on the sine grid (without spreading).
void LineGrid::make_field(const Input& input, int block, int sample, Thread& memory) const {
  const Background& background = input.background;
  const auto cells = static_cast<std::size_t>(cells_);
  const auto field = std::span(memory.field).first(cells), sum = std::span(memory.sum).first(cells);
  std::fill(field.begin(), field.end(), std::complex<float>{});
  if (hears_field(background)) {
    filter(input, sample - block * kBlock, memory.isotropic, sum);
    const auto amplitude = static_cast<float>(std::sqrt(background.isotropic_upa2));
    for (std::size_t c = 0; c < cells; ++c) field[c] += amplitude * isotropic_share_[c] * sum[c];
  }
  if (!background.volume_upa2.empty()) {
    filter(input, sample - block * kBlock, memory.volume, sum);
    const float* mean_square = background.volume_upa2.data() + static_cast<std::size_t>(sample) * cells;
    for (std::size_t c = 0; c < cells; ++c) field[c] += std::sqrt(mean_square[c]) * sum[c];
  }
}

/// From one row of the spread grid to the elements' signals.
void LineGrid::to_elements(const Input& input, int block, int sample, Thread& memory) const {
  const int r = sample - block * kBlock;
  std::complex<float>* row = memory.grid.data() + static_cast<std::ptrdiff_t>(r) * stride_;
  std::complex<float>* grid = row + kLeft;
  for (int i = 0; i < kLeft; ++i) row[i + cells_] += row[i];
  for (int i = kLeft; i < kWidth; ++i) row[i] += row[i + cells_];
  std::complex<float>* spectrum = memory.spectrum.data();
  to_elements_(grid, spectrum);

  const int M = line_.elements;
  std::complex<float>* elements = memory.elements.data() + static_cast<std::ptrdiff_t>(r) * M;
  const float* const unspread = unspread_.data();
  for_harmonics([=](int m, int h) { elements[m] = spectrum[h] * unspread[m]; });
  const Background& background = input.background;
  if (hears_field(background) || !background.volume_upa2.empty()) {
    make_field(input, block, sample, memory);
    to_elements_(memory.field.data(), spectrum);
    for_harmonics([=](int m, int h) { elements[m] += spectrum[h]; });
  }
  if (hears_elements(background)) {
    const auto sum = std::span(memory.sum).first(static_cast<std::size_t>(M));
    filter(input, r, memory.noise, sum);
    const std::complex<float>* const noise = sum.data();
    for (int m = 0; m < M; ++m) elements[m] += noise[m];
  }
}

/// Element signals of a block, weighted, onto the grid that beams read.
void LineGrid::to_beam_grid(int samples, std::span<const float> weights, Thread& memory) const {
  const int M = line_.elements;
  std::complex<float>* spectrum = memory.spectrum.data();
  std::fill_n(spectrum, cells_, std::complex<float>{});  // and so it stays between the elements' harmonics
  float* const scale = memory.scale.data();
  for (int m = 0; m < M; ++m) scale[m] = weights[static_cast<std::size_t>(m)] * unspread_[static_cast<std::size_t>(m)];
  for (int r = 0; r < samples; ++r) {
    std::complex<float>* row = memory.grid.data() + static_cast<std::ptrdiff_t>(r) * stride_;
    const std::complex<float>* elements = memory.elements.data() + static_cast<std::ptrdiff_t>(r) * M;
    for_harmonics([=](int m, int h) { spectrum[h] = elements[m] * scale[m]; });
    to_beams_(spectrum, row + kLeft);
    for (int i = 0; i < kLeft; ++i) row[i] = row[i + cells_];
    for (int i = kLeft; i < kWidth; ++i) row[i + cells_] = row[i];
  }
}

void LineGrid::form_block(const Input& input, int block, std::span<const std::span<const float>> weights,
                          const Form& form, Memory& memory, std::span<Image> images) const {
  const Background& background = input.background;
  const int first = block * kBlock, samples = std::min(kBlock, input.sampling.count - first);
  const bool silent = !hears_field(background) && !hears_elements(background) && background.volume_upa2.empty() &&
                      !memory.points.any(block);
  if (silent) {
    silence(first, samples, images, form);
    return;
  }
  Thread& own = memory.threads[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
  {
    const profile::Span span(profile::Stage::kSpread);
    std::fill(own.grid.begin(), own.grid.end(), std::complex<float>{});
    spread(memory.points, block, input.pulse, spreading_, own.grid.data(), stride_);
  }
  {
    const profile::Span span(profile::Stage::kNoise);
    draw(input, block, own);
  }
  const profile::Span span(profile::Stage::kTransforms);
  for (int sample = first; sample < first + samples; ++sample) to_elements(input, block, sample, own);
  const auto grid_stride = static_cast<std::size_t>(stride_);
  if (form.halved) {
    for (std::size_t i = 0; i < 2; ++i) {
      to_beam_grid(samples, weights[i + 1], own);
      own.rows[i].set(own.grid.data(), grid_stride);
    }
    read_beams(block, samples, memory.steer, own.rows, images, form);
    return;
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    to_beam_grid(samples, weights[i], own);
    own.rows[0].set(own.grid.data(), grid_stride);
    read_beams(block, samples, memory.steer, std::span(own.rows).first(1), images.subspan(i, 1), form);
  }
}

}  // namespace ensonify::echo
