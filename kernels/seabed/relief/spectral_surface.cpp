#include "kernels/seabed/relief/spectral_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "kernels/seabed/relief/exponential.h"
#include "kernels/seabed/relief/spline.h"
#include "kernels/seabed/relief/spline_variance.h"

namespace ensonify::relief {

SpectralSurface::SpectralSurface(const Spectrum& spectrum, double post_spacing_m, std::uint64_t seed,
                                 std::string_view name)
    : spectrum_(spectrum),
      octaves_(octaves_of(spectrum, post_spacing_m)),
      octave_noise_(seed, std::string(name) + "/octaves"),
      post_noise_(seed, std::string(name) + "/posts") {
  for (const double variance_m2 : octaves_.variance_m2) {
    const auto level = static_cast<int>(node_sd_m_.size());
    node_sd_m_.push_back(static_cast<float>(std::sqrt(variance_m2 / variance_at_posts(level))));
  }
}

void SpectralSurface::fill(const Window& window, std::span<float> height_m, const Field& amplitude) const {
  const int top = std::max(window.level, static_cast<int>(octaves_.variance_m2.size()) - 1);
  std::vector<Window> windows{knots_of(window)};  // of level window.level, then coarser ones
  while (windows.back().level < top) windows.push_back(coarser(windows.back()));
  Grid now{windows.back(), std::vector<float>(windows.back().size(), 0.0F)}, next;
  std::vector<float> by;
  for (std::size_t i = windows.size(); i-- > 0;) {
    if (now.window != windows[i]) {
      next.window = windows[i];
      refine(now, next);
      std::swap(now, next);
    }
    const auto level = static_cast<std::size_t>(windows[i].level);
    if (level >= node_sd_m_.size() || node_sd_m_[level] == 0.0F) continue;
    if (amplitude) {
      by.resize(now.window.size());
      amplitude(now.window, by);
    }
    add_white(octave_noise_, node_sd_m_[level], by, now.window, now.value);
  }
  evaluate(now, window, height_m);
  if (window.level > 0 || octaves_.below_posts_m2 < 1e-9 * spectrum_.rms_m * spectrum_.rms_m) return;
  if (amplitude) {
    by.resize(window.size());
    amplitude(window, by);
  }
  add_white(post_noise_, static_cast<float>(std::sqrt(octaves_.below_posts_m2)), by, window, height_m);
}

void fill_from_level(int finest_level, const Field& at_level, const Window& window, std::span<float> out) {
  if (window.level >= finest_level) return at_level(window, out);
  std::vector<Window> windows{window};
  while (windows.back().level < finest_level) windows.push_back(coarser(windows.back()));
  Grid now{windows.back(), std::vector<float>(windows.back().size())}, next;
  at_level(now.window, now.value);
  for (std::size_t i = windows.size() - 1; i-- > 0;) {
    next.window = windows[i];
    refine(now, next);
    std::swap(now, next);
  }
  std::copy(now.value.begin(), now.value.end(), out.begin());
}

LognormalCascade::LognormalCascade(const CascadeParameters& parameters, double post_spacing_m, std::uint64_t seed,
                                   std::string_view name)
    : finest_(parameters.finest_level), noise_(seed, std::string(name) + "/cascade") {
  if (!(parameters.intermittency >= 0.0 && parameters.intermittency <= 0.7))
    throw std::invalid_argument("cascade: intermittency is " + std::to_string(parameters.intermittency) +
                                ", allowed: 0 to 0.7");
  if (!(parameters.outer_scale_m > 0.0 && post_spacing_m > 0.0) || parameters.finest_level < 0)
    throw std::invalid_argument("cascade: outer scale and spacing must be positive, the finest level not negative");
  // Most of a surface's variance is made by the octave whose nodes are a sixth of the outer scale apart.
  coarsest_ = static_cast<int>(std::lround(std::log2(parameters.outer_scale_m / (6.0 * post_spacing_m))));
  node_sd_ = static_cast<float>(std::sqrt(parameters.intermittency * std::numbers::ln2 / variance_of_coefficients(20)));
}

void LognormalCascade::fill(const Window& window, std::span<float> amplitude) const {
  const auto at_level = [this](const Window& nodes, std::span<float> out) {
    std::vector<Window> windows{nodes};
    while (windows.back().level < coarsest_) windows.push_back(coarser(windows.back()));
    Grid now{windows.back(), std::vector<float>(windows.back().size(), 0.0F)}, next;
    double variance = 0.0;
    for (std::size_t i = windows.size() - 1; i-- > 0;) {
      add_white(noise_, node_sd_, {}, now.window, now.value);
      next.window = windows[i];
      refine(now, next);
      std::swap(now, next);
      variance += node_sd_ * node_sd_ * variance_of_coefficients(static_cast<int>(i) + 1);
    }
    const auto offset = static_cast<float>(variance);  // E exp(2 (g - variance)) = 1
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = exponential(now.value[i] - offset);
  };
  fill_from_level(finest_, at_level, window, amplitude);
}

double LognormalCascade::ln_variance() const {
  double variance = 0.0;
  for (int octaves = coarsest_ - finest_; octaves > 0; --octaves)
    variance += node_sd_ * node_sd_ * variance_of_coefficients(octaves);
  return variance;
}

HeightGain::HeightGain(SpectralSurface reference, double gain, int finest_level)
    : reference_(std::move(reference)), gain_(gain), finest_(finest_level) {
  if (!(std::abs(gain) <= 1.0))
    throw std::invalid_argument("height gain is " + std::to_string(gain) + ", allowed: -1 to 1");
}

void HeightGain::fill(const Window& window, std::span<float> amplitude) const {
  const double rms_m = reference_.spectrum().rms_m;
  if (rms_m == 0.0) {
    std::fill(amplitude.begin(), amplitude.end(), 1.0F);
    return;
  }
  const auto at_level = [this, rms_m](const Window& nodes, std::span<float> out) {
    // Octaves coarser than this level only, so that the amplitude knows nothing of the noise that it multiplies.
    const auto above = [this](const Window& coarse, std::span<float> height_m) { reference_.fill(coarse, height_m); };
    fill_from_level(nodes.level + 1, above, nodes, out);
    const auto per_m = static_cast<float>(gain_ / rms_m), offset = static_cast<float>(ln_variance(nodes.level));
    for (float& x : out) x = exponential(per_m * x - offset);
  };
  fill_from_level(finest_, at_level, window, amplitude);
}

double HeightGain::ln_variance() const { return reference_.spectrum().rms_m == 0.0 ? 0.0 : ln_variance(finest_); }

double HeightGain::ln_variance(int level) const {
  const double rms_m = reference_.spectrum().rms_m;
  double variance = 0.0;
  const std::vector<double>& octaves = reference_.octaves().variance_m2;
  for (auto k = static_cast<std::size_t>(level) + 1; k < octaves.size(); ++k) variance += octaves[k] / (rms_m * rms_m);
  return gain_ * gain_ * variance;
}

}  // namespace ensonify::relief
