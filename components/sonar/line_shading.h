#pragma once

#include <string_view>

#include "kernels/acoustics/array/shading.h"

namespace ensonify {

class ConfigReader;

/// Reads how a line of a head is shaded from the section `key`: window, and of a Dolph-Chebyshev or Taylor window
/// side_lobe_db and nbar, within what array::shading_weights takes. What is left out stays as it is.
void read_shading(ConfigReader& from, std::string_view key, array::Shading& shading);

}  // namespace ensonify
