#pragma once

#include <optional>
#include <string>

#include "messages/console.h"
#include "messages/navigation.h"
#include "messages/terrain.h"

namespace ensonify::console {

constexpr double kReliefExaggeration = 4.0;
constexpr std::size_t kMostContourPieces = 40'000;

/// Shaded relief, lit from the north-west at 45 degrees as maps are, with contours at a round step: about ten of them.
/// The shade is Lambert's cosine of the exaggerated slope; slopes are central differences of neighbouring posts.
msg::ConsoleRelief relief_of(const msg::Chart& chart);

/// Of a run whose chart nobody has: without relief, and with the map that a position names in both ways, in metres and
/// in degrees. Nothing for a position without degrees.
std::optional<msg::ConsoleRelief> map_of(const msg::Position& position);

/// 1, 2 or 5 times a power of ten, so that a range has at most ten steps.
double contour_step(double range_m);

/// The chart/1 at the start of a record, or of the records in a folder. Nothing where there is none.
std::optional<msg::Chart> chart_in(const std::string& file_or_folder);

}  // namespace ensonify::console
