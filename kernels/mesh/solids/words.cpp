#include "kernels/mesh/solids/words.h"

#include <cstddef>

namespace ensonify::solids {
namespace {

using Sizes = std::array<double, 3>;

constexpr std::array<const char*, std::variant_size_v<Solid>> kWords{"sphere", "box",   "cylinder", "plate", "cone",
                                                                     "tyre",   "pipe",  "bottle",   "shell", "wedge",
                                                                     "cable",  "chain", "",         "mesh"};
constexpr std::array kFigures{"ladder",    "trap", "anchor", "mooring", "person",      "boat",  "aircraft",
                              "propeller", "net",  "hook",   "valve",   "sheet_piles", "wreck", "broken_aircraft"};

Sizes sizes(const Sphere& one) { return {one.diameter_m, 0.0, 0.0}; }
Sizes sizes(const Box& one) { return {one.size_m.x(), one.size_m.y(), one.size_m.z()}; }
Sizes sizes(const Cylinder& one) { return {one.diameter_m, one.length_m, 0.0}; }
Sizes sizes(const Plate& one) { return {one.size_m.x(), one.size_m.y(), 0.0}; }
Sizes sizes(const Cone& one) { return {one.diameter_m, one.top_diameter_m, one.height_m}; }
Sizes sizes(const Tyre& one) { return {one.diameter_m, one.width_m, 0.0}; }
Sizes sizes(const Pipe& one) { return {one.diameter_m, one.length_m, one.wall_m}; }
Sizes sizes(const Bottle& one) { return {one.diameter_m, one.length_m, 0.0}; }
Sizes sizes(const Shell& one) { return {one.diameter_m, one.length_m, 0.0}; }
Sizes sizes(const Wedge& one) { return {one.size_m.x(), one.size_m.y(), one.size_m.z()}; }
Sizes sizes(const Cable& one) { return {one.diameter_m, one.length_m, one.sag_m}; }
Sizes sizes(const Chain& one) { return {one.wire_m, one.length_m, one.sag_m}; }
Sizes sizes(const Figure& one) { return {one.size_m.x(), one.size_m.y(), one.size_m.z()}; }
Sizes sizes(const Mesh& one) { return {one.scale, 0.0, 0.0}; }

}  // namespace

const char* word_of(const Solid& solid) {
  if (const auto* figure = std::get_if<Figure>(&solid)) return kFigures[static_cast<std::size_t>(figure->kind)];
  return kWords[solid.index()];
}

std::array<double, 3> sizes_of(const Solid& solid) {
  return std::visit([](const auto& one) { return sizes(one); }, solid);
}

std::optional<Solid> solid_of(const std::string& word, const std::array<double, 3>& sizes) {
  const auto& [a, b, c] = sizes;
  if (word == "sphere") return Sphere{a};
  if (word == "box") return Box{{a, b, c}};
  if (word == "cylinder") return Cylinder{a, b};
  if (word == "plate") return Plate{{a, b}};
  if (word == "cone") return Cone{a, b, c};
  if (word == "tyre") return Tyre{a, b};
  if (word == "pipe") return Pipe{a, b, c};
  if (word == "bottle") return Bottle{a, b};
  if (word == "shell") return Shell{a, b};
  if (word == "wedge") return Wedge{{a, b, c}};
  if (word == "cable") return Cable{a, b, c};
  if (word == "chain") return Chain{a, b, c};
  for (std::size_t kind = 0; kind < kFigures.size(); ++kind) {
    if (word == kFigures[kind]) return Figure{static_cast<Figure::Kind>(kind), {a, b, c}};
  }
  return std::nullopt;
}

}  // namespace ensonify::solids
