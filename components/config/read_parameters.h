#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "components/config/config_reader.h"
#include "components/config/parameters.h"

/// Reading of what a parameter list names.
namespace ensonify {

/// Reads every parameter of the list, then checks them together. What is left out stays as it is. A struct's
/// `void read_base(ConfigReader& from)` is called first: for a file that the map names and whose values it changes.
template <class T>
void read_parameters(ConfigReader& from, T& values);

/// Adds a problem where the text is given and empty.
void refuse_empty(const ConfigReader& from, const char* key, const std::string& text);

namespace detail {

class ParameterReader {
 public:
  explicit ParameterReader(ConfigReader& from) : from_(from) {}

  template <class T>
  void operator()(const char* key, const char* unit, const Allowed& allowed, const char*, T& member) const {
    read(key, unit, allowed, member);
  }
  template <class T>
  void operator()(const char* key, const char*, T& member) const {
    read_structure(key, member);
  }

 private:
  template <class T>
  void read(const char* key, const char* unit, const Allowed& allowed, T& member) const {
    if constexpr (ReadsItself<T>) {
      member.read(from_, key);
    } else if constexpr (IsOptional<T>::value) {
      if (!allowed.required && !from_.has(key)) return;
      typename T::value_type found{};
      const std::size_t before = from_.problem_count();
      read(key, unit, allowed, found);
      if (from_.problem_count() == before) member = std::move(found);
    } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>) {
      if (!allowed.words.empty()) {
        read_word(key, allowed, [&](const Word& word) { member = static_cast<T>(word.value); });
      } else if constexpr (std::is_same_v<T, bool>) {
        allowed.required ? from_.required(key, member) : from_.optional(key, member);
      }
    } else if constexpr (std::is_same_v<T, std::string>) {
      read_text(key, allowed, member);
    } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
      allowed.required ? from_.required(key, member) : from_.optional(key, member);
    } else {
      read_number(key, unit, allowed, member);
    }
  }

  template <class T>
  void read_number(const char* key, const char* unit, const Allowed& allowed, T& member) const {
    const FileUnit si{file_unit(unit)};
    if constexpr (FixedVector<T>) {
      std::array<double, T::SizeAtCompileTime> numbers;
      std::copy(member.begin(), member.end(), numbers.begin());
      read_number(key, unit, allowed, numbers);
      std::copy(numbers.begin(), numbers.end(), member.begin());
    } else if constexpr (FixedVectors<T>) {
      using Row = typename T::value_type;
      std::vector<std::array<double, Row::SizeAtCompileTime>> rows;
      read_number(key, unit, allowed, rows);
      if (from_.has(key)) member.clear();
      for (const auto& row : rows) std::copy(row.begin(), row.end(), member.emplace_back(Row::Zero()).begin());
    } else {
      if constexpr (std::is_integral_v<T>) {
        if (!allowed.bounded()) {
          allowed.required ? from_.required(key, member) : from_.optional(key, member);
          return;
        }
      }
      if (allowed.required) {
        from_.required(key, member, allowed.lo, allowed.hi, si);
      } else {
        from_.optional(key, member, allowed.lo, allowed.hi, si);
      }
    }
  }

  void read_text(const char* key, const Allowed& allowed, std::string& member) const {
    if (!allowed.words.empty()) {
      read_word(key, allowed, [&](const Word& word) { member = word.text; });
    } else if (allowed.text == Allowed::Text::kPath) {
      allowed.required ? from_.required_path(key, member) : from_.optional_path(key, member);
    } else {
      allowed.required ? from_.required(key, member) : from_.optional(key, member);
      if (allowed.text == Allowed::Text::kNotEmpty) refuse_empty(from_, key, member);
    }
  }

  template <class Set>
  void read_word(const char* key, const Allowed& allowed, const Set& set) const {
    ConfigReader::Choices<const Word*> choices;
    for (const Word& word : allowed.words) choices.emplace_back(word.text, &word);
    const Word* found = nullptr;
    allowed.required ? from_.required_choice(key, found, choices) : from_.optional_choice(key, found, choices);
    if (found) set(*found);
  }

  template <class T>
  void read_structure(const char* key, T& member) const {
    if constexpr (IsOptional<T>::value) {
      if (auto section = from_.optional_section(key)) read_parameters(*section, member.emplace());
    } else if constexpr (ListOfParameters<T>) {
      if (from_.has(key)) member.clear();
      if constexpr (NamedParameters<typename T::value_type>) {
        for (auto& [name, entry] : from_.named_sections(key)) {
          typename T::value_type values{};
          values.*(T::value_type::kNamedBy) = name;
          read_parameters(entry, values);
          member.push_back(std::move(values));
        }
      } else {
        for (ConfigReader& entry : from_.list(key)) {
          member.emplace_back();
          read_parameters(entry, member.back());
        }
      }
    } else if (auto section = from_.optional_section(key)) {
      read_parameters(*section, member);
    }
  }

  ConfigReader& from_;
};

}  // namespace detail

template <class T>
void read_parameters(ConfigReader& from, T& values) {
  if constexpr (requires { values.read_base(from); }) values.read_base(from);
  ParametersOf<T>::parameters(values, detail::ParameterReader(from));
  if constexpr (requires { ParametersOf<T>::check(from, values); }) ParametersOf<T>::check(from, values);
}

}  // namespace ensonify
