#include <cmath>
#include <iostream>

#include "kernels/base/frames/local_projection.h"
#include "kernels/water/sound_speed.h"
#include "messages/codec.h"
#include "messages/motion.h"

/// Uses a kernel, a kernel that needs an external library, and the codec.
int main() {
  using namespace ensonify;
  const double sound_speed_mps = water::sound_speed_mps(25.0, 35.0, 1000.0);

  const frames::LocalProjection map{{.latitude_deg = 59.0, .longitude_deg = 10.0}};
  const frames::Geodetic place = map.geodetic_of(map.enu_of({.latitude_deg = 59.01, .longitude_deg = 10.02}));

  msg::Guidance sent;
  sent.heading_grid_rad = 1.25;
  const auto received = msg::decode<msg::Guidance>(msg::encode(sent), 1 << 20);

  const bool well = std::abs(sound_speed_mps - 1550.744) < 1e-3 && std::abs(place.longitude_deg - 10.02) < 1e-9 &&
                    received.heading_grid_rad == sent.heading_grid_rad;
  std::cout << (well ? "consumer: all well\n" : "consumer: wrong results\n");
  return well ? 0 : 1;
}
