#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

/// One layer of the seabed: a height field and how it joins what lies below it.
struct Layer {
  enum class Join {
    kAdd,    // bottom + mask * height
    kCover,  // the higher of bottom and height: sediment fills hollows, outcrops stand out of it
    kCut,    // the lower of bottom and height: dredging
  };
  Field height_m;  // kAdd: relative to the bottom; else ENU z, or above an earlier bottom
  Join join = Join::kAdd;
  std::optional<std::size_t> above;  // kCover, kCut: height counts from the bottom as it was when so many layers lay
                                     // on the base; none: from ENU z 0
  Field mask = nullptr;              // none: 1 everywhere. kCover, kCut: the share of the way to the new height
  std::optional<std::uint8_t> sediment;  // the class where the layer shows; none: what was there
  double shows_above_m = 0.0;            // it shows where the mask is a half or more and it moved the bottom by more
                                         // than this
};

/// A seabed from layers, bottom up. Heights and classes are functions of the post.
class Seabed {
 public:
  /// `base_m`: the macro shape, ENU z. `base_class`: a class per node (whole numbers), or none for class 0.
  Seabed(Field base_m, Field base_class, std::vector<Layer> layers);

  /// Heights (ENU z, m) and, if the span is not empty, sediment classes at the window's nodes.
  void fill(const Window& window, std::span<float> height_m, std::span<std::uint8_t> sediment) const;

 private:
  Field base_m_, base_class_;
  std::vector<Layer> layers_;
};

/// One number everywhere.
Field constant(float value);

/// Product, largest and sum of fields, node by node; of none: 1, 0 and 0.
Field product(std::vector<Field> fields);
Field largest(std::vector<Field> fields);
Field sum(std::vector<Field> fields);

/// low where `mask` is 0, high where it is 1, in proportion between.
Field blend(Field mask, float low, float high);

}  // namespace ensonify::relief
