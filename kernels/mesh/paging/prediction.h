#pragma once

#include <vector>

#include "kernels/mesh/paging/near.h"

namespace ensonify::paging {

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

}  // namespace ensonify::paging
