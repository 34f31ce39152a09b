#include "kernels/seabed/relief/combine.h"

#include <algorithm>
#include <utility>

namespace ensonify::relief {
namespace {

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
