#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "components/config/config_error.h"
#include "components/config/config_node.h"
#include "components/config/parse_yaml.h"

namespace ensonify {

/// Factor from the file's unit to SI: `from.optional("heading_deg", heading_rad, -180, 360, kDegrees)` reads degrees,
/// checks the range in degrees and stores radians.
struct FileUnit {
  double si = 1.0;
};
inline constexpr FileUnit kSi{1.0};
inline constexpr FileUnit kDegrees{3.14159265358979323846 / 180.0};
inline constexpr FileUnit kKnots{1852.0 / 3600.0};
inline constexpr FileUnit kMilliseconds{1e-3};

/// Reads a user's YAML into a struct and collects every mistake of the whole document: wrong types, values out of
/// range, NaN and infinities, missing, unknown and duplicate keys. finish() throws them together as one ConfigError, so
/// a user corrects a file once. A value with a problem leaves the variable as it was.
///
///   from.required("frequency_hz", config.frequency_hz, 100e3, 1e6);
///   from.optional("pulse_length_s", config.pulse_length_s, 1e-6, 1e-2);  // absent: the struct's initialiser stays
///   from.finish();
///
/// Copies are handles to the same document. Sections need no finish() of their own; the document's finish() covers
/// them.
class ConfigReader {
 public:
  /// Reads a file; throws ConfigError when it cannot be read or is not a YAML map.
  static ConfigReader from_file(const std::string& path);
  /// Reads text, e.g. in tests: `ConfigReader::from_text("frequency_hz: 50000", "head.yaml")`.
  static ConfigReader from_text(const std::string& text, const std::string& file);
  /// Reads a tree that was parsed before; `path` is put before every key in messages ("processes.bow.config").
  explicit ConfigReader(ConfigDocument document, const std::string& path = "");

  // --- one value; `lo` and `hi` are inclusive and in the unit of the file -------------------------------------------
  template <class T>
  void required(std::string_view key, T& value) {
    read(key, value, true);
  }
  template <class T>
  void optional(std::string_view key, T& value) {
    read(key, value, false);
  }
  template <class T, class Lo, class Hi>
  void required(std::string_view key, T& value, Lo lo, Hi hi, FileUnit unit = kSi) {
    read(key, value, true, lo, hi, unit);
  }
  template <class T, class Lo, class Hi>
  void optional(std::string_view key, T& value, Lo lo, Hi hi, FileUnit unit = kSi) {
    read(key, value, false, lo, hi, unit);
  }

  /// One of a few words: from.optional_choice("kind", kind, {{"synthetic", Kind::kSynthetic}, {"raster",
  /// Kind::kRaster}}).
  template <class Enum>
  using Choices = std::vector<std::pair<std::string, Enum>>;
  template <class Enum>
  void required_choice(std::string_view key, Enum& value, const Choices<std::type_identity_t<Enum>>& choices) {
    choose(key, value, choices, true);
  }
  template <class Enum>
  void optional_choice(std::string_view key, Enum& value, const Choices<std::type_identity_t<Enum>>& choices) {
    choose(key, value, choices, false);
  }

  /// An existing file or folder. A relative path is searched for beside the file that names it, then in the project's
  /// own data (data_paths.h); one that was typed on the command line first in the working folder. Gives the path found.
  void required_path(std::string_view key, std::string& path) { read_path(key, path, true); }
  void optional_path(std::string_view key, std::string& path) { read_path(key, path, false); }

  // --- structure ----------------------------------------------------------------------------------------------------
  /// A nested map that must be there; when it is not, that is one problem and reading from the result does nothing.
  ConfigReader section(std::string_view key) const;
  /// A nested map that may be left out. With `short_key` a single value is short for the map with that key alone, here
  /// and in what follows.
  std::optional<ConfigReader> optional_section(std::string_view key, std::string_view short_key = "") const;
  /// A list of maps, empty when left out.
  std::vector<ConfigReader> list(std::string_view key, std::string_view short_key = "") const;
  /// A map from names that the user chooses to maps, in the order of the file; empty when left out.
  std::vector<std::pair<std::string, ConfigReader>> named_sections(std::string_view key,
                                                                   std::string_view short_key = "") const;
  /// The value as it stands, unread; nullptr when left out. Lives as long as the document.
  const ConfigNode* node(std::string_view key) const;
  /// The map that this reader reads.
  const ConfigNode& node() const;

  bool has(std::string_view key) const;
  /// Whether the value of `key` is this word.
  bool holds_word(std::string_view key, const std::string& word) const;
  /// The keys of this map that somebody has asked for so far.
  std::vector<std::string> known_keys() const;
  /// Adds a problem of the caller's own at the place of `key` (or of the map, when the key is left out). A key inside
  /// is written as messages show it, "channels[1].name"; where it is left out, the place is that of what should hold
  /// it.
  void problem(std::string_view key, const std::string& message) const;
  /// Such a problem, not added: for what is found only when other files have been read.
  ConfigProblem problem_at(std::string_view key, const std::string& message) const;
  /// Adds another document to the same list of problems, e.g. a file that this one names.
  ConfigReader also(ConfigDocument document, const std::string& path = "") const;
  /// Adds problems that were found elsewhere, e.g. those of a file that could not be parsed.
  void add(const ConfigError& error) const;

  /// True as long as nothing is wrong in the whole document (unknown keys are found by finish() only).
  bool good() const;
  /// Number of problems so far.
  std::size_t problem_count() const;
  /// Throws ConfigError with all problems of the document and of those added by also(), unknown keys among them.
  /// On a section it does nothing.
  void finish() const;

 private:
  struct Documents;
  struct State;
  explicit ConfigReader(std::shared_ptr<State> state) : state_(std::move(state)) {}

  static constexpr double kHighest = std::numeric_limits<double>::max();
  static constexpr double kLowest = -kHighest;
  struct NumberRange {
    double lo = kLowest;
    double hi = kHighest;
    double si_per_unit = 1.0;
  };
  struct IntegerRange {
    std::int64_t lo = std::numeric_limits<std::int64_t>::min();
    std::int64_t hi = std::numeric_limits<std::int64_t>::max();
  };

  const ConfigNode* take(std::string_view key, bool must, const std::string& allowed) const;
  bool scalar(const ConfigNode& node, const std::string& path, double& value, const NumberRange& range) const;
  std::optional<double> number(std::string_view key, bool must, const NumberRange& range) const;
  std::optional<std::int64_t> integer(std::string_view key, bool must, const IntegerRange& range) const;
  std::optional<std::uint64_t> natural(std::string_view key, bool must) const;
  bool numbers(std::string_view key, std::span<double> values, bool must, const NumberRange& range) const;
  std::optional<std::vector<double>> any_numbers(std::string_view key, bool must, const NumberRange& range) const;
  std::optional<std::vector<double>> rows(std::string_view key, std::size_t width, bool must,
                                          const NumberRange& range) const;
  std::optional<std::size_t> word(std::string_view key, const std::vector<std::string>& words, bool must) const;
  ConfigReader child(const ConfigNode& node, const std::string& path, std::string_view short_key = "") const;
  void read_path(std::string_view key, std::string& path, bool must) const;

  void read(std::string_view key, bool& value, bool must) const;
  void read(std::string_view key, std::string& value, bool must) const;
  void read(std::string_view key, std::vector<std::string>& value, bool must) const;

  template <class T>
  requires std::is_floating_point_v<T>
  void read(std::string_view key, T& value, bool must, double lo = kLowest, double hi = kHighest,
            FileUnit unit = kSi) const {
    if (const auto found = number(key, must, {lo, hi, unit.si})) {
      value = static_cast<T>(*found);
    }
  }
  template <class T>
  requires(std::is_integral_v<T> && !std::is_same_v<T, bool>) void read(std::string_view key, T& value,
                                                                        bool must) const {
    if constexpr (std::is_same_v<T, std::uint64_t>) {
      if (const auto found = natural(key, must)) {
        value = *found;
      }
    } else {
      read(key, value, must, std::numeric_limits<T>::min(), std::numeric_limits<T>::max());
    }
  }
  template <class T, class Lo, class Hi>
  requires(std::is_integral_v<T> && !std::is_same_v<T, bool>) void read(std::string_view key, T& value, bool must,
                                                                        Lo lo, Hi hi, FileUnit = kSi) const {
    if (const auto found = integer(key, must, {static_cast<std::int64_t>(lo), static_cast<std::int64_t>(hi)})) {
      value = static_cast<T>(*found);
    }
  }
  template <std::size_t N>
  void read(std::string_view key, std::array<double, N>& value, bool must, double lo = kLowest, double hi = kHighest,
            FileUnit unit = kSi) const {
    std::array<double, N> found{};
    if (numbers(key, found, must, {lo, hi, unit.si})) {
      value = found;
    }
  }
  void read(std::string_view key, std::vector<double>& value, bool must, double lo = kLowest, double hi = kHighest,
            FileUnit unit = kSi) const {
    if (auto found = any_numbers(key, must, {lo, hi, unit.si})) {
      value = std::move(*found);
    }
  }
  /// A list of lists of N numbers, e.g. the places of a line.
  template <std::size_t N>
  void read(std::string_view key, std::vector<std::array<double, N>>& value, bool must, double lo = kLowest,
            double hi = kHighest, FileUnit unit = kSi) const {
    if (const auto found = rows(key, N, must, {lo, hi, unit.si})) {
      value.resize(found->size() / N);
      for (std::size_t i = 0; i < found->size(); ++i) value[i / N][i % N] = (*found)[i];
    }
  }
  template <class T, class... Rest>
  void read(std::string_view key, std::optional<T>& value, bool must, Rest... rest) const {
    if (must || has(key)) {
      T found{};
      const std::size_t before = problem_count();
      read(key, found, must, rest...);
      if (problem_count() == before) {
        value = found;
      }
    }
  }

  template <class Enum>
  void choose(std::string_view key, Enum& value, const Choices<Enum>& choices, bool must) const {
    std::vector<std::string> words;
    for (const auto& choice : choices) {
      words.push_back(choice.first);
    }
    if (const auto index = word(key, words, must)) {
      value = choices[*index].second;
    }
  }

  std::shared_ptr<State> state_;
};

/// Checks `ensonify: launch/1` at the head of a file against the format that the reader knows.
void read_format(ConfigReader& from, const std::string& known_format);

}  // namespace ensonify
