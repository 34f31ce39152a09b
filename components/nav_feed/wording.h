#pragma once

#include <string>

/// Amounts as health says them, of their magnitude.
namespace ensonify {

/// "3 h 0 min", "2 min 5 s", "18.0 s".
std::string duration_text(double seconds);

/// "50.0 km", "120 m".
std::string distance_text(double metres);

}  // namespace ensonify
