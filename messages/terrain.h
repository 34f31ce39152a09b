#pragma once

#include <cstdint>

#include "messages/array.h"

namespace ensonify::msg {

struct Tile {
  static constexpr const char* kType = "tile/1";
  static constexpr const char* kAbout = "A square piece of seabed. Truth.";
  std::int64_t col = 0;
  std::int64_t row = 0;
  double origin_east_m = 0.0;
  double origin_north_m = 0.0;
  double spacing_m = 1.0;
  Array<float> height_m;
  Array<std::uint8_t> sediment;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("col", "1", "tile index, east", self.col);
    visit("row", "1", "tile index, north", self.row);
    visit("origin_east_m", "m", "world east of the south-west post (false origin)", self.origin_east_m);
    visit("origin_north_m", "m", "world north of the south-west post (false origin)", self.origin_north_m);
    visit("spacing_m", "m", "distance between posts, both axes", self.spacing_m);
    visit("height_m", "m", "posts (north x east, south-west first), up from chart datum; NaN is a hole", self.height_m);
    visit("sediment", "1", "sediment class of each post, as height_m", self.sediment);
  }
};

struct TileRelease {
  static constexpr const char* kType = "tile_release/1";
  static constexpr const char* kAbout = "The pager will not refer to this tile again until it sends it anew.";
  std::int64_t col = 0;
  std::int64_t row = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("col", "1", "tile index, east", self.col);
    visit("row", "1", "tile index, north", self.row);
  }
};

struct Chart {
  static constexpr const char* kType = "chart/1";
  static constexpr const char* kAbout =
      "What is known of the terrain as a whole, as a chart would tell: mission planning may use it.";
  double origin_latitude_deg = 0.0;
  double origin_longitude_deg = 0.0;
  double west_m = 0.0;
  double south_m = 0.0;
  double east_m = 0.0;
  double north_m = 0.0;
  double shallowest_m = 0.0;
  double deepest_m = 0.0;
  double spacing_m = 1.0;
  Array<float> height_m;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("origin_latitude_deg", "deg",
          "geodetic latitude of the world's origin, WGS 84 (a scenario may leave it to the raster)",
          self.origin_latitude_deg);
    visit("origin_longitude_deg", "deg", "longitude of the world's origin, WGS 84", self.origin_longitude_deg);
    visit("west_m", "m", "world east of the western edge", self.west_m);
    visit("south_m", "m", "world north of the southern edge", self.south_m);
    visit("east_m", "m", "world east of the eastern edge", self.east_m);
    visit("north_m", "m", "world north of the northern edge", self.north_m);
    visit("shallowest_m", "m", "least depth below chart datum, positive down", self.shallowest_m);
    visit("deepest_m", "m", "greatest depth below chart datum, positive down", self.deepest_m);
    visit("spacing_m", "m", "distance between the posts of height_m", self.spacing_m);
    visit("height_m", "m", "coarse heights (north x east, south-west first), up; NaN where nothing is known",
          self.height_m);
  }
};

}  // namespace ensonify::msg
