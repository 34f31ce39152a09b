#include "kernels/acoustics/echo/line_receiver.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "kernels/base/profile/profile.h"

namespace ensonify::echo {
namespace {

const ContributorSet kAll;

std::vector<float> autocorrelation(std::span<const float> weights) {
  const auto count = static_cast<std::ptrdiff_t>(weights.size());
  std::vector<float> power;
  for (std::ptrdiff_t lag = 1 - count; lag < count; ++lag) {
    double sum = 0.0;
    for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, -lag); i < std::min(count, count - lag); ++i) {
      sum += static_cast<double>(weights[static_cast<std::size_t>(i)]) * weights[static_cast<std::size_t>(i + lag)];
    }
    power.push_back(static_cast<float>(sum));
  }
  return power;
}

/// A line whose elements' weights are such.
ElementLine power_line(const ElementLine& line) {
  return {2 * line.elements - 1, line.spacing_in_waves, line.axis_head};
}

bool alike(const WantedImage& a, const WantedImage& b) { return a.sum == b.sum && a.contributors == b.contributors; }

}  // namespace

ElementLine element_line(const array::LineArray& array, double wavelength_m, const Eigen::Vector3f& axis_head) {
  return {array.elements(), array.spacing_m / wavelength_m, axis_head};
}

std::vector<float> beam_weights(std::span<const double> weights, std::span<const double> whole) {
  const double sum = std::accumulate(whole.begin(), whole.end(), 0.0);
  if (!(std::abs(sum) > 0.0)) throw std::invalid_argument("the weights of a beam must not sum to 0");
  std::vector<float> scaled;
  for (const double weight : weights) scaled.push_back(static_cast<float>(weight / sum));
  return scaled;
}

std::vector<float> beam_weights(std::span<const double> weights) { return beam_weights(weights, weights); }

SharedByBeams shared_by_beams(const ElementLine& line, std::span<const float> weights) {
  const double middle = 0.5 * static_cast<double>(weights.size() - 1);
  std::vector<double> squares;
  for (const float weight : weights) squares.push_back(static_cast<double>(weight) * static_cast<double>(weight));
  const double all = std::accumulate(squares.begin(), squares.end(), 0.0);
  const auto pattern = [&](double sine) {
    std::complex<double> sum;
    for (std::size_t m = 0; m < squares.size(); ++m) {
      const double turns = line.spacing_in_waves * (static_cast<double>(m) - middle) * sine;
      sum += squares[m] / all * std::polar(1.0, 2.0 * std::numbers::pi * turns);
    }
    return sum;
  };
  return {{pattern, std::max(line.spacing_in_waves * middle, 0.5)}, line.axis_head};
}

WantedImage::WantedImage(std::vector<float> of_elements, Sum how, ContributorSet whose)
    : weights(std::move(of_elements)), sum(how), contributors(std::move(whose)) {
  if (sum == Sum::kMeanSquare) power_weights = autocorrelation(weights);
}

LineReceiver::LineReceiver(const ElementLine& line, bool mean_squares) : pressure_(line) {
  if (mean_squares) power_.emplace(power_line(line));
}

void LineReceiver::form(const Input& input, std::span<const float> sin_beams, std::span<const WantedImage> wanted,
                        std::span<Image> images, Memory& memory) const {
  const profile::Span span(profile::Stage::kBeamform);
  if (wanted.size() != images.size())
    throw std::invalid_argument("a line receiver needs one image for each wanted one");
  std::size_t end = 0;
  for (std::size_t first = 0; first < wanted.size(); first = end) {
    for (end = first + 1; end < wanted.size() && alike(wanted[first], wanted[end]);) ++end;
    const std::span<float> amplitude_upa = first == 0 ? input.amplitude_upa : std::span<float>{};
    const bool done = form_alike(input, sin_beams, wanted.subspan(first, end - first),
                                 images.subspan(first, end - first), amplitude_upa, memory);
    if (!done && !amplitude_upa.empty()) echo::amplitude_upa(images.front(), amplitude_upa);
  }
}

bool LineReceiver::form_alike(const Input& input, std::span<const float> sin_beams, std::span<const WantedImage> wanted,
                              std::span<Image> images, std::span<float> amplitude_upa, Memory& memory) const {
  const ContributorSet& whose = wanted.front().contributors;
  Background background;
  if (whose.holds(trace::kNoise)) background = input.background;
  memory.weights.clear();
  for (const WantedImage& one : wanted) memory.weights.push_back(one.weights);
  if (wanted.front().sum == Sum::kPressure) {
    return pressure_.form({input.echoes, whose, input.pulse, input.sampling, background}, sin_beams, memory.weights,
                          images, amplitude_upa, memory.grid);
  }
  if (!power_ || !input.squared)
    throw std::invalid_argument("images of mean squares need a receiver and a pulse for them");
  pressure_.form({{}, kAll, input.pulse, input.sampling, background}, sin_beams, memory.weights, images, {},
                 memory.grid);
  memory.coherent.resize(input.coherent.empty() ? 0 : wanted.size());
  if (!memory.coherent.empty()) {
    pressure_.form({input.coherent, whose, input.pulse, input.sampling, {}}, sin_beams, memory.weights, memory.coherent,
                   {}, memory.grid);
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::span<const float> weights = wanted[i].power_weights;
    power_->form({input.echoes, whose, *input.squared, input.sampling, {}}, sin_beams, {&weights, 1},
                 memory.mean_square, {}, memory.grid);
    const auto& mean_square = memory.mean_square.front().envelope_upa;
    auto& envelope = images[i].envelope_upa;
    const auto coherent_upa2 = [&](std::size_t k) {
      return memory.coherent.empty() ? 0.0F : std::norm(memory.coherent[i].envelope_upa[k]);
    };
    for (std::size_t k = 0; k < envelope.size(); ++k)
      envelope[k] += std::sqrt(std::max(0.0F, mean_square[k].real()) + coherent_upa2(k));
  }
  return false;
}

}  // namespace ensonify::echo
