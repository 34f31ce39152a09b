#pragma once

#include <string>

#include "kernels/vehicle/motion/helm.h"

namespace ensonify {

/// A vehicle as its forces describe it, and what steers it.
struct HydrodynamicVehicle {
  motion::HydrodynamicParameters body;
  motion::HelmParameters helm;
};

inline constexpr const char* kDynamicsFormat = "dynamics/1";

/// Reads such a vehicle's file (remus_100.yaml beside this one explains the keys). Throws ConfigError with every
/// problem.
HydrodynamicVehicle read_dynamics(const std::string& path);

}  // namespace ensonify
