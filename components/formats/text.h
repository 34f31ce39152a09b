#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace ensonify::formats {

/// A text in a field of N characters: cut to fit, zeros behind it, one at least.
template <std::size_t N>
std::array<char, N> padded(std::string_view text) {
  std::array<char, N> field{};
  std::copy_n(text.begin(), std::min(text.size(), N - 1), field.begin());
  return field;
}

/// The text of such a field, up to its first zero.
template <std::size_t N>
std::string unpadded(const std::array<char, N>& field) {
  return {field.begin(), std::find(field.begin(), field.end(), '\0')};
}

}  // namespace ensonify::formats
