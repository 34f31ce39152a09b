#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
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

/// Motion of a vehicle over ground at a moment.
struct Motion {
  Vec2 position_enu_m = Vec2::Zero();
  Vec2 velocity_enu_mps = Vec2::Zero();
  double turn_rate_radps = 0.0;  // of its track, counter-clockwise seen from above (towards north from east)
};

/// Place after a time, speed and turn rate unchanged: on a circle of radius speed / turn rate, or straight ahead.
Vec2 place_after(const Motion& motion, double time_s);

/// Need of a predicted track for a tile.
struct Need {
  TileKey key;
  double due_s = 0.0;       // from now until it lies within the margin; infinite: it does not
  double distance_m = 0.0;  // of the tile from the nearest place of the track
  bool operator==(const Need&) const = default;
};

struct Horizon {
  double ahead_s = 60.0;    // the track is followed for so long
  double step_s = 0.5;      // and evaluated so often: a tile is due at the first update that finds it within the margin
  double margin_m = 100.0;  // nearer than this, a tile is due
  double wide_margin_m = 200.0;  // nearer than this, it is needed: the vehicle may turn. At least margin_m
};

/// The tiles of a terrain within the wide margin of the predicted track, in the order in which they should be fetched:
/// those due soonest first; those not due by their distance from the track; ties by distance, then key.
/// Throws std::invalid_argument unless step_s > 0, ahead_s >= 0 and wide_margin_m >= margin_m.
std::vector<Need> needs(const TileGrid& grid, const Box& terrain, const Motion& motion, const Horizon& horizon);

/// Last time that tiles lay within reach of the heads or were needed, in updates counted from the start.
using LastWanted = std::map<TileKey, std::int64_t>;

/// Which tiles memory is to hold now, at most `most`: those needed, in their order; then what it holds already, the
/// last wanted first (the least recently wanted are given up first), equally old ones by key. In order of importance.
std::vector<TileKey> to_hold(std::span<const TileKey> needed, const LastWanted& held, std::size_t most);

/// Rule for tiles that heads hold: tiles nearer than `feed_m` are given to them, those beyond `release_m`
/// taken away, and between the two all stays as it is, so that a vehicle at the border does not send tiles to and fro.
struct Margins {
  double feed_m = 100.0;
  double release_m = 150.0;  // at least feed_m
};
struct Exchange {
  std::vector<TileKey> give;  // nearest first
  std::vector<TileKey> take;  // by key
};
/// `held` are the keys that heads hold, in any order. Throws std::invalid_argument unless release_m >= feed_m.
Exchange exchange(const TileGrid& grid, const Box& terrain, const Vec2& place, const Margins& margins,
                  std::span<const TileKey> held);

}  // namespace ensonify::paging
