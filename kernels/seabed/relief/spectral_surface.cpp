#include "kernels/seabed/relief/spectral_surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernels/seabed/relief/spline.h"

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

}  // namespace ensonify::relief
