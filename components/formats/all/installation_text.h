#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ensonify::formats::all {

/// The KEY=value pairs of an installation text, in its order. What has no '=' is left out.
std::vector<std::pair<std::string, std::string>> installation_values(std::string_view text);

}  // namespace ensonify::formats::all
