#include "kernels/seabed/relief/seabed.h"

#include <algorithm>
#include <cmath>
#include <map>
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

template <class Join>
Field joined(std::vector<Field> fields, float of_none, Join join) {
  return [fields = std::move(fields), of_none, join](const Window& window, std::span<float> out) {
    if (fields.empty()) {
      std::fill(out.begin(), out.end(), of_none);
      return;
    }
    fields.front()(window, out);
    std::vector<float> more(fields.size() > 1 ? out.size() : 0);
    for (std::size_t f = 1; f < fields.size(); ++f) {
      fields[f](window, more);
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = join(out[i], more[i]);
    }
  };
}

}  // namespace

Seabed::Seabed(Field base_m, Field base_class, std::vector<Layer> layers)
    : base_m_(std::move(base_m)), base_class_(std::move(base_class)), layers_(std::move(layers)) {
  if (!base_m_) throw std::invalid_argument("seabed: there is no base to lay layers on");
  for (std::size_t n = 0; n < layers_.size(); ++n) {
    if (!layers_[n].height_m) throw std::invalid_argument("seabed: a layer has no height");
    if (layers_[n].above && *layers_[n].above > n)
      throw std::invalid_argument("seabed: a layer's height counts from a bottom that is not there yet");
  }
}

void Seabed::fill(const Window& window, std::span<float> height_m, std::span<std::uint8_t> sediment) const {
  base_m_(window, height_m);
  std::vector<float> layer_m(window.size()), mask(window.size(), 1.0F);
  if (!sediment.empty()) {
    if (base_class_) base_class_(window, layer_m);
    for (std::size_t i = 0; i < sediment.size(); ++i) sediment[i] = static_cast<std::uint8_t>(layer_m[i]);
  }
  const auto needed_later = [this](std::size_t n) {
    return std::any_of(layers_.begin() + static_cast<std::ptrdiff_t>(n), layers_.end(),
                       [n](const Layer& layer) { return layer.above == n; });
  };
  std::map<std::size_t, std::vector<float>> bottoms;  // by how many layers lie on the base
  for (std::size_t n = 0; n < layers_.size(); ++n) {
    const Layer& layer = layers_[n];
    if (needed_later(n)) bottoms[n].assign(height_m.begin(), height_m.end());
    layer.height_m(window, layer_m);
    if (layer.above) {
      const std::vector<float>& bottom = bottoms.at(*layer.above);
      for (std::size_t i = 0; i < layer_m.size(); ++i) layer_m[i] += bottom[i];
    }
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

Field constant(float value) {
  return [value](const Window&, std::span<float> out) { std::fill(out.begin(), out.end(), value); };
}

Field product(std::vector<Field> fields) {
  return joined(std::move(fields), 1.0F, [](float a, float b) { return a * b; });
}

Field largest(std::vector<Field> fields) {
  return joined(std::move(fields), 0.0F, [](float a, float b) { return std::max(a, b); });
}

Field sum(std::vector<Field> fields) {
  return joined(std::move(fields), 0.0F, [](float a, float b) { return a + b; });
}

Field blend(Field mask, float low, float high) {
  return [mask = std::move(mask), low, high](const Window& window, std::span<float> out) {
    mask(window, out);
    for (float& x : out) x = low + x * (high - low);
  };
}

}  // namespace ensonify::relief
