#pragma once

#include "kernels/mesh/solids/solid.h"
#include "messages/terrain.h"

namespace ensonify {

/// Puts a shape into a message, and takes it out again; the latter throws std::invalid_argument for one that does not
/// exist.
void put_shape(const solids::Solid& solid, msg::Object& message);
solids::Solid solid_of(const msg::Object& message);

/// The object's surface where it stands (solids::surface_of).
solids::Surface surface_of(const msg::Object& message, double sagitta_m);

}  // namespace ensonify
