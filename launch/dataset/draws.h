#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/config_reader.h"

namespace ensonify::dataset {

/// A value of a recipe in which distributions may stand in place of values, at any depth:
///
///   {uniform: [0.4, 0.6]}   {log_uniform: [1, 100]}   {normal: [8, 2], within: [4, 12]}
///   {integer: [0, 3]}       {one_of: [mud, sand], weights: [1, 2]}
///   {by_split: {train: mud, val: mud, test: sand}}
///
/// What one_of and by_split choose may be a distribution too.
struct Drawn {
  ConfigNode tree;  // null: left out

  Drawn() = default;
  /// Without a distribution, or one as a file has it.
  explicit Drawn(const std::string& text);
  bool operator==(const Drawn& other) const;

  bool given() const { return !tree.is_null(); }
  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const { return tree; }
  static std::string schema() { return "{}"; }
};

/// What a value is drawn for. The same gives the same, in any order.
struct Counter {
  std::uint64_t seed = 1;
  std::uint64_t scene = 0;
  std::uint64_t item = 0;     // of the scene
  std::uint64_t attempt = 0;  // of that item; below 2^32
  std::string split = "train";
};

/// Drawn values by the path of their key.
using Values = std::vector<std::pair<std::string, ConfigNode>>;

/// The tree with a value in place of each distribution. A distribution's numbers follow from its path in the recipe,
/// `path` and on, and the counter: another one beside it changes nothing. Adds what it has drawn to `values`.
ConfigNode draw(const ConfigNode& tree, const std::string& path, const Counter& at, Values* values = nullptr);

/// Draws one number. Throws ConfigError where it is none, or lies outside.
double draw_number(const Drawn& from, const std::string& path, const Counter& at, double lo, double hi);

/// Two numbers of a sequence that fills (0, 1) x (0, 1) evenly: of any n successive ones the share in an interval is
/// right within a few of n. Halton's points of bases 2 and 3 [Halton1960]; within each block of 2^k, or 3^k, they come
/// in an order that is drawn, so that no step through the sequence has a pattern.
std::array<double, 2> even(std::uint64_t seed, std::uint64_t number);

}  // namespace ensonify::dataset
