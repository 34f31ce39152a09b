#include "components/terrain/layered_seabed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <variant>

#include "components/config/config_error.h"
#include "kernels/seabed/relief/guide.h"
#include "kernels/seabed/relief/seabed.h"
#include "kernels/seabed/relief/spectral_surface.h"
#include "kernels/seabed/relief/spectrum.h"

namespace ensonify::source {
namespace {

using relief::Field;
using relief::Window;

/// A field that owns the kernel that fills it.
template <class Kernel>
Field owned(Kernel kernel) {
  auto shared = std::make_shared<const Kernel>(std::move(kernel));
  return [shared](const Window& window, std::span<float> out) { shared->fill(window, out); };
}

relief::Marks marks_in(const relief::MarkParameters& form, const std::string& layer, double post_spacing_m,
                       std::uint64_t seed) {
  return {form, post_spacing_m, seed, "seabed/" + layer};
}

Field heights_of(const relief::Seabed& seabed) {
  auto shared = std::make_shared<const relief::Seabed>(seabed);
  return [shared](const Window& window, std::span<float> out) { shared->fill(window, out, {}); };
}

/// Threshold that a standard Gaussian exceeds with probability `share`, by bisection.
double exceeded_by(double share) {
  double low = -6.0, high = 6.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Makes the layers one after another; each may ask for what lies below it.
class Maker {
 public:
  Maker(const LayeredSeabed& seabed, double post_spacing_m, const GuideReader& read_guide)
      : description_(seabed), spacing_m_(post_spacing_m), read_guide_(read_guide) {}

  LayeredFields make() {
    for (const layers::Layer& layer : description_.layers) {
      try {
        if (layer.used) layers_.push_back(layer_of(layer));
      } catch (const std::invalid_argument& error) {
        throw ConfigError({ConfigProblem{{description_.file, 0, 0}, "seabed.layers." + layer.name, error.what()}});
      }
      count_by_name_[layer.name] = layers_.size();
    }
    return {up_to(layers_.size()), std::move(masks_), std::move(rough_)};
  }

 private:
  relief::Seabed up_to(std::size_t count) const {
    return {relief::constant(0.0F), nullptr, {layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(count)}};
  }
  /// How many layers lie under and with the one of that name.
  std::size_t count_of(const std::string& name) const {
    return name.empty() ? std::min<std::size_t>(1, layers_.size()) : count_by_name_.at(name);
  }
  int level_of(double scale_m) const {
    return std::max(0, static_cast<int>(std::lround(std::log2(scale_m / spacing_m_))));
  }

  relief::Layer layer_of(const layers::Layer& layer) {
    relief::Layer made;
    made.height_m = std::visit([&](const auto& form) { return height_of(form, layer.name); }, layer.form);
    made.join = layer.join;
    if (!layer.above.empty()) made.above = count_of(layer.above);
    if (layer.mask) made.mask = masks_[layer.name] = mask_of(*layer.mask, layer.name);
    made.sediment = layer.sediment;
    made.shows_above_m = std::holds_alternative<layers::Paint>(layer.form) ? -1.0 : layer.shows_above_m;
    return made;
  }

  // --- masks ---

  Field mask_of(const layers::Mask& mask, const std::string& name) const {
    std::vector<Field> terms;
    const int level = level_of(mask.scale_m);
    if (mask.depth_m || mask.slope || mask.curvature_1pm) {
      const Field height_m = heights_of(up_to(count_of(mask.of)));
      if (mask.depth_m) {
        const Field depth_m = [height_m, level](const Window& window, std::span<float> out) {
          relief::fill_from_level(level, height_m, window, out);
          for (float& z : out) z = -z;
        };
        terms.push_back(in_band(depth_m, *mask.depth_m));
      }
      if (mask.slope) terms.push_back(in_band(slope_of(height_m, spacing_m_, level), *mask.slope));
      if (mask.curvature_1pm) terms.push_back(in_band(curvature_of(height_m, spacing_m_, level), *mask.curvature_1pm));
    }
    if (!mask.polygon_enu_m.empty())
      terms.push_back(relief::in_polygon(mask.polygon_enu_m, mask.polygon_softness_m, spacing_m_));
    if (!mask.sediments.empty()) terms.push_back(share_of(mask.sediments, level));
    if (mask.patches) terms.push_back(patches_of(*mask.patches, name));
    std::vector<Field> any;
    for (std::size_t i = 0; i < mask.any.size(); ++i)
      any.push_back(mask_of(mask.any[i], name + "/any" + std::to_string(i)));
    if (!any.empty()) terms.push_back(relief::largest(std::move(any)));
    const Field whole = terms.size() == 1 ? terms.front() : relief::product(std::move(terms));
    return mask.reverse ? relief::outside(whole) : whole;
  }

  /// 1 where the seabed below has one of the classes, blended over about two nodes of the level.
  Field share_of(const std::vector<std::uint8_t>& classes, int level) const {
    const auto below = std::make_shared<const relief::Seabed>(up_to(layers_.size()));
    const Field at_level = [below, classes](const Window& window, std::span<float> out) {
      std::vector<std::uint8_t> sediment(out.size());
      below->fill(window, out, sediment);
      for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = std::find(classes.begin(), classes.end(), sediment[i]) != classes.end() ? 1.0F : 0.0F;
    };
    return [level, at_level](const Window& window, std::span<float> out) {
      relief::fill_from_level(level, at_level, window, out);
    };
  }

  /// Relief of some roughness, cut off at the height that `share` of it exceeds: outlines with bays and islands.
  Field patches_of(const layers::Mask::Patches& patches, const std::string& name) const {
    const relief::Spectrum outline{
        .rms_m = 1.0, .hurst = 0.7, .outer_scale_m = 2.0 * patches.length_m, .inner_scale_m = 0.05 * patches.length_m};
    return in_band(spectral_field(outline, "seabed/" + name + "/patches"),
                   {.low = exceeded_by(patches.share), .softness = patches.softness});
  }

  Field spectral_field(const relief::Spectrum& spectrum, const std::string& name,
                       const Field& amplitude = nullptr) const {
    const auto surface = std::make_shared<const relief::SpectralSurface>(spectrum, spacing_m_, description_.seed, name);
    return [surface, amplitude](const Window& window, std::span<float> out) { surface->fill(window, out, amplitude); };
  }

  // --- heights ---

  Field height_of(const layers::Paint&, const std::string&) const { return relief::constant(0.0F); }
  Field height_of(const relief::Plane& shape, const std::string&) const { return plane(shape, spacing_m_); }
  Field height_of(const relief::Ramp& shape, const std::string&) const { return ramp(shape, spacing_m_); }
  Field height_of(const relief::Wave& shape, const std::string&) const { return wave(shape, spacing_m_); }
  Field height_of(const relief::Sphere& shape, const std::string&) const { return sphere(shape, spacing_m_); }
  Field height_of(const relief::Ridge& shape, const std::string&) const { return ridge(shape, spacing_m_); }

  Field height_of(const layers::Spectral& form, const std::string& layer) {
    const std::string name = "seabed/" + layer;
    std::vector<Field> amplitude;
    if (form.intermittency > 0.0) {
      amplitude.push_back(owned(
          relief::LognormalCascade({.intermittency = form.intermittency, .outer_scale_m = form.spectrum.outer_scale_m},
                                   spacing_m_, description_.seed, name)));
    }
    if (form.height_gain != 0.0) {
      amplitude.push_back(owned(relief::HeightGain(
          relief::SpectralSurface(form.spectrum, spacing_m_, description_.seed, name), form.height_gain)));
    }
    if (form.rough) {
      const Field rough = rough_[layer] = mask_of(*form.rough, layer + "/rough");
      amplitude.push_back(relief::blend(rough, static_cast<float>(form.smooth_amplitude), 1.0F));
    }
    const Field shape =
        spectral_field(form.spectrum, name, amplitude.empty() ? Field() : relief::product(std::move(amplitude)));
    return form.mean_m == 0.0 ? shape : relief::sum({relief::constant(static_cast<float>(form.mean_m)), shape});
  }

  Field height_of(const relief::RippleParameters& form, const std::string& layer) const {
    return owned(relief::Ripples(form, spacing_m_, description_.seed, "seabed/" + layer));
  }
  Field height_of(const relief::MarkParameters& form, const std::string& layer) const {
    return owned(marks_in(form, layer, spacing_m_, description_.seed));
  }
  Field height_of(const relief::BodyParameters& form, const std::string& layer) const {
    return owned(relief::Bodies(form, spacing_m_, description_.seed, "seabed/" + layer));
  }
  Field height_of(const layers::Dredged& form, const std::string&) const {
    return relief::dredge_cut(form.line_enu_m, form.half_width_m, form.side_slope, spacing_m_);
  }

  // --- guides ---

  Field height_of(const layers::Guide& form, const std::string&) const {
    return relief::smooth_surface(read_guide_(form), spacing_m_);
  }

  Field height_of(const layers::Restored& form, const std::string& layer) const {
    const auto guide = std::find_if(description_.layers.begin(), description_.layers.end(),
                                    [&](const layers::Layer& other) { return other.name == form.guide; });
    const auto* what = guide == description_.layers.end() ? nullptr : std::get_if<layers::Guide>(&guide->form);
    if (what == nullptr) throw std::invalid_argument("guide: " + form.guide + " is not a layer that is a guide");
    relief::Raster raster = read_guide_(*what);
    const relief_statistics::Surface surface{raster.columns, raster.rows, raster.cell_m, std::move(raster.value)};
    const relief::Detail detail = relief::detail_below(surface, form.hurst, form.band_start_cells);
    if (detail.spectrum.rms_m == 0.0)
      throw std::invalid_argument("the guide has no whole window of 16 cells to take a strength from");
    return spectral_field(detail.spectrum, "seabed/" + layer);
  }

  const LayeredSeabed& description_;
  double spacing_m_;
  const GuideReader& read_guide_;
  std::vector<relief::Layer> layers_;
  std::map<std::string, std::size_t> count_by_name_;
  std::map<std::string, Field> masks_, rough_;  // by layer
};

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

LayeredFields fields_of(const LayeredSeabed& seabed, double post_spacing_m, const GuideReader& read_guide) {
  return Maker(seabed, post_spacing_m, read_guide).make();
}

std::vector<NamedMark> marks_of(const LayeredSeabed& seabed, double post_spacing_m) {
  const frames::Vec2 south_west = seabed.centre_enu_m - 0.5 * seabed.size_m, north_east = south_west + seabed.size_m;
  std::vector<NamedMark> marks;
  for (const layers::Layer& layer : seabed.layers) {
    const auto* form = std::get_if<relief::MarkParameters>(&layer.form);
    if (form == nullptr || !layer.used) continue;
    for (const relief::Mark& mark :
         marks_in(*form, layer.name, post_spacing_m, seabed.seed).within(south_west, north_east))
      if (relief::intersects(mark, south_west, north_east)) marks.push_back({layer.name, mark});
  }
  return marks;
}

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
