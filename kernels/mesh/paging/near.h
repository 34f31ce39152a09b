#pragma once

#include <cstddef>
#include <vector>

#include "kernels/mesh/tile.h"

/// Which tiles of a seabed a vehicle needs, when, and which of them memory keeps: docs/physics/mesh/paging.md.
namespace ensonify::paging {

using terrain::TileGrid;
using terrain::TileKey;
using terrain::Vec2;

/// A rectangle with sides along the axes, m; its border belongs to it.
struct Box {
  Vec2 low = Vec2::Zero();   // south-west corner
  Vec2 high = Vec2::Zero();  // north-east corner
};

/// From a place to the nearest point of a box, m; 0 inside.
double distance_m(const Box& box, const Vec2& place);

/// The rectangle that a tile covers.
Box box_of(const TileGrid& grid, const TileKey& key);

/// The tiles of a terrain whose boxes lie within `margin_m` of a place, the border included: nearest first, equally
/// near ones by key.
std::vector<TileKey> tiles_near(const TileGrid& grid, const Box& terrain, const Vec2& place, double margin_m);

/// An upper bound of the tiles that any place on an endless grid has within the margin: what memory must be ready for.
/// Places are tried a 16th of a side apart with the margin widened by half the diagonal between them.
std::size_t most_tiles_near(double side_m, double margin_m);

}  // namespace ensonify::paging
