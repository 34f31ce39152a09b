#pragma once

#include <string>
#include <vector>

namespace ensonify::physics {

/// The values of an input as the user wrote it: a number, or `from:to:step`. A sweep begins at `from`, goes up or down
/// as its step says, and ends at the last value that does not pass `to`.
///
/// std::invalid_argument with cause and what is allowed: for text that is neither, a step that never arrives, a value
/// outside [low, high] or more than kMostRows values.
std::vector<double> sweep(const std::string& text, double low, double high);

constexpr double kMostRows = 1e6;

}  // namespace ensonify::physics
