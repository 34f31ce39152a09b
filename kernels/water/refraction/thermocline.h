#pragma once

#include "kernels/water/refraction/profile.h"

namespace ensonify::refraction {

/// An example for tests, benchmarks and pictures: a warm surface layer over a sharp summer thermocline, ten layers over
/// 80 m, 32 m/s of fall. Its shape is that of shelf seas in summer; the numbers are ours.
inline SoundSpeedProfile summer_thermocline() {
  return SoundSpeedProfile({{0, 1522.0},
                            {8, 1521.8},
                            {12, 1519.0},
                            {16, 1514.0},
                            {20, 1508.0},
                            {25, 1502.0},
                            {30, 1497.5},
                            {40, 1493.0},
                            {50, 1490.5},
                            {65, 1489.5},
                            {80, 1489.8}});
}

}  // namespace ensonify::refraction
