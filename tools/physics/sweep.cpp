#include "tools/physics/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace ensonify::physics {
namespace {

constexpr double kRounding = 1e-9;  // of a step: 0:0.3:0.1 has four values

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stopped == end ? std::optional(value) : std::nullopt;
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> found;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    const auto value = number(text.substr(begin, end - begin));
    if (!value) throw std::invalid_argument(fmt::format("'{}' is neither a number nor a sweep from:to:step", text));
    found.push_back(*value);
    begin = end + 1;
  }
  if (found.size() == 2 || found.size() > 3) {
    throw std::invalid_argument(fmt::format("'{}' has {} numbers; a sweep is from:to:step", text, found.size()));
  }
  return found;
}

}  // namespace

std::vector<double> sweep(const std::string& text, double low, double high) {
  const std::vector<double> given = numbers(text);
  const double from = given.front();
  const double to = given.size() == 3 ? given[1] : from;
  for (const double value : {from, to}) {
    if (!(value >= low && value <= high)) {
      throw std::invalid_argument(fmt::format("{:g} is outside [{:g}, {:g}]", value, low, high));
    }
  }
  if (given.size() == 1) return given;
  const double steps = (to - from) / given[2];
  if (!(steps >= 0.0)) {
    throw std::invalid_argument(fmt::format("a step of {:g} never goes from {:g} to {:g}", given[2], from, to));
  }
  if (!(steps < kMostRows)) {
    throw std::invalid_argument(fmt::format("'{}' has more than {:.0f} values", text, kMostRows));
  }
  std::vector<double> values(static_cast<std::size_t>(std::floor(steps + kRounding)) + 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = std::clamp(from + static_cast<double>(i) * given[2], std::min(from, to), std::max(from, to));
  }
  return values;
}

}  // namespace ensonify::physics
