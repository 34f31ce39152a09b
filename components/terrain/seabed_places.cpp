#include "components/terrain/seabed_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <variant>

namespace ensonify::source {
namespace {

using relief::Window;

constexpr int kBlocks = 8;  // along either axis, at most
constexpr int kSide = 8;    // nodes of a block along either axis: the neighbours of one cost next to nothing

/// Calls with every mask of the layers that are used, those within masks too.
template <class What>
void for_masks_in(const layers::Mask& mask, const What& what) {
  what(mask);
  for (const layers::Mask& one : mask.any) for_masks_in(one, what);
}
template <class What>
void for_masks_of(const layers::Layer& layer, const What& what) {
  if (layer.mask) for_masks_in(*layer.mask, what);
  const auto* spectral = std::get_if<layers::Spectral>(&layer.form);
  if (spectral != nullptr && spectral->rough) for_masks_in(*spectral->rough, what);
}

/// The level of the lattice at which the finest of all masks is evaluated.
int level_of(const LayeredSeabed& seabed, double post_spacing_m) {
  double finest_m = std::numeric_limits<double>::infinity();
  for (const layers::Layer& layer : seabed.layers) {
    if (!layer.used) continue;
    for_masks_of(layer, [&](const layers::Mask& mask) { finest_m = std::min(finest_m, mask.scale_m); });
  }
  if (!std::isfinite(finest_m)) return 0;
  return std::max(0, static_cast<int>(std::lround(std::log2(finest_m / post_spacing_m))));
}

std::vector<Window> blocks_of(const LayeredSeabed& seabed, double post_spacing_m, int level) {
  const double step_m = relief::node_spacing_m(post_spacing_m, level);
  const auto count_along = [&](double side_m) {
    return std::clamp(static_cast<int>(side_m / (kSide * step_m)), 1, kBlocks);
  };
  const int columns = count_along(seabed.size_m.x()), rows = count_along(seabed.size_m.y());
  std::vector<Window> blocks;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const frames::Vec2 share((i + 0.5) / columns - 0.5, (j + 0.5) / rows - 0.5);
      const frames::Vec2 middle = (seabed.centre_enu_m + share.cwiseProduct(seabed.size_m)) / step_m;
      blocks.push_back(
          {level, std::llround(middle.x()) - kSide / 2, std::llround(middle.y()) - kSide / 2, kSide, kSide});
    }
  }
  return blocks;
}

std::vector<float> sampled(const relief::Field& field, const std::vector<Window>& blocks) {
  std::vector<float> values;
  std::vector<float> block(blocks.front().size());
  for (const Window& window : blocks) {
    field(window, block);
    values.insert(values.end(), block.begin(), block.end());
  }
  return values;
}

std::vector<std::uint8_t> classes_at(const relief::Seabed& seabed, const std::vector<Window>& blocks) {
  std::vector<std::uint8_t> classes;
  std::vector<float> height_m(blocks.front().size());
  std::vector<std::uint8_t> block(blocks.front().size());
  for (const Window& window : blocks) {
    seabed.fill(window, height_m, block);
    classes.insert(classes.end(), block.begin(), block.end());
  }
  return classes;
}

}  // namespace

SeabedPlaces places_of(const LayeredSeabed& seabed, double post_spacing_m, const LayeredFields& fields,
                       const std::set<std::string>& layers) {
  const auto blocks = blocks_of(seabed, post_spacing_m, level_of(seabed, post_spacing_m));
  SeabedPlaces places;
  places.count = blocks.size() * blocks.front().size();
  places.seabed_class = classes_at(fields.seabed, blocks);
  for (const std::string& layer : layers) {
    if (const auto mask = fields.masks.find(layer); mask != fields.masks.end())
      places.mask[layer] = sampled(mask->second, blocks);
    if (const auto rough = fields.rough.find(layer); rough != fields.rough.end())
      places.rough[layer] = sampled(rough->second, blocks);
  }
  return places;
}

}  // namespace ensonify::source
