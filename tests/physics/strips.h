#pragma once

#include <cmath>
#include <cstdint>

#include "components/sonar/effects.h"
#include "components/sonar/environment.h"
#include "components/sonar/testing/config.h"
#include "kernels/seabed/backscatter.h"
#include "messages/terrain.h"

/// Bright strips of a dark level seabed, for whole heads to part.
namespace ensonify::physics {

/// A level seabed, its posts from these corners.
struct StripedSeabed {
  double depth_m = 10.0, post_m = 0.01;
  double west_m = 0.0, south_m = 0.0, east_m = 1.0, north_m = 1.0;
};

/// Sediment 1 where `bright` says so of (east, north), else 0.
template <class Bright>
msg::Tile striped(const StripedSeabed& of, const Bright& bright) {
  const auto posts = [&](double from_m, double to_m) {
    return static_cast<std::size_t>(std::lround((to_m - from_m) / of.post_m)) + 1;
  };
  const std::size_t rows = posts(of.south_m, of.north_m), columns = posts(of.west_m, of.east_m);
  msg::Tile tile;
  tile.origin_east_m = of.west_m;
  tile.origin_north_m = of.south_m;
  tile.spacing_m = of.post_m;
  tile.height_m = msg::Array<float>({rows, columns});
  tile.sediment = msg::Array<std::uint8_t>({rows, columns});
  for (float& height : tile.height_m.flat()) height = static_cast<float>(-of.depth_m);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t col = 0; col < columns; ++col) {
      const double east_m = of.west_m + of.post_m * static_cast<double>(col);
      tile.sediment(row, col) = bright(east_m, of.south_m + of.post_m * static_cast<double>(row)) ? 1 : 0;
    }
  }
  return tile;
}

/// The strips' sediments, and sums of mean squares: the mean over the strips' phases.
template <class Config>
void receive_strips(Config& config) {
  world_of(config).water.profile.sound_speed_mps = 1500.0;
  world_of(config).seabed.sediments[0] = seabed::Lambert{-120.0};
  world_of(config).seabed.sediments[1] = seabed::Lambert{-10.0};
  config.effects.noise = config.effects.multipath = config.effects.speckle = config.effects.absorption = false;
}

}  // namespace ensonify::physics
