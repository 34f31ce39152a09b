#pragma once

#include <array>
#include <optional>
#include <string>

#include "kernels/mesh/solids/solid.h"

/// A solid as a word and up to three sizes: as scenarios and messages have it.
namespace ensonify::solids {

/// sphere, box, cylinder, plate, cone, tyre, pipe, bottle, shell, wedge; a figure's; mesh.
const char* word_of(const Solid& solid);

/// Its sizes in the order of its members, then 0; of a mesh its scale.
std::array<double, 3> sizes_of(const Solid& solid);

/// The solid again; nothing for a word that does not exist, or a mesh, whose triangles are elsewhere.
std::optional<Solid> solid_of(const std::string& word, const std::array<double, 3>& sizes);

}  // namespace ensonify::solids
