#include "kernels/relief/seabed.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace ensonify::relief {
namespace {

float joined(Layer::Join join, float bottom, float layer, float mask) {
  switch (join) {
    case Layer::Join::kAdd: return bottom + mask * layer;
    case Layer::Join::kCover: return bottom + mask * std::max(0.0F, layer - bottom);
    case Layer::Join::kCut: return bottom + mask * std::min(0.0F, layer - bottom);
  }
  return bottom;
}

}  // namespace

Seabed::Seabed(Field base_m, Field base_class, std::vector<Layer> layers)
    : base_m_(std::move(base_m)), base_class_(std::move(base_class)), layers_(std::move(layers)) {
  if (!base_m_) throw std::invalid_argument("seabed: there is no base to lay layers on");
  for (const Layer& layer : layers_) {
    if (!layer.height_m) throw std::invalid_argument("seabed: a layer has no height");
  }
}

void Seabed::fill(const Window& window, std::span<float> height_m, std::span<std::uint8_t> sediment) const {
  base_m_(window, height_m);
  std::vector<float> layer_m(window.size()), mask(window.size(), 1.0F);
  if (!sediment.empty()) {
    if (base_class_) base_class_(window, layer_m);
    for (std::size_t i = 0; i < sediment.size(); ++i) sediment[i] = static_cast<std::uint8_t>(layer_m[i]);
  }
  for (const Layer& layer : layers_) {
    layer.height_m(window, layer_m);
    if (layer.mask) layer.mask(window, mask);
    else std::fill(mask.begin(), mask.end(), 1.0F);
    const auto least = static_cast<float>(layer.shows_above_m);
    for (std::size_t i = 0; i < height_m.size(); ++i) {
      const float before = height_m[i];
      height_m[i] = joined(layer.join, before, layer_m[i], mask[i]);
      if (layer.sediment && !sediment.empty() && mask[i] >= 0.5F && std::abs(height_m[i] - before) > least)
        sediment[i] = *layer.sediment;
    }
  }
}

}  // namespace ensonify::relief
