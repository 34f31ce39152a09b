#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/config/config_reader.h"
#include "components/config/parameters.h"

/// Reading of what a parameter list names.
namespace ensonify {

/// Reads every parameter of the list, then checks them together. What is left out stays as it is. A struct's
/// `void read_base(ConfigReader& from)` is called first: for a file that the map names and whose values it changes.
/// `void complete(ConfigReader& from)` is called last.
template <class T>
void read_parameters(ConfigReader& from, T& values);

/// Adds a problem where the text is given and empty.
void refuse_empty(const ConfigReader& from, const char* key, const std::string& text);

namespace detail {

/// Keys of a list.
struct KeyCollector {
  std::vector<std::string>& keys;
  void operator()(const char* key, auto&&...) const { keys.emplace_back(key); }
  void operator()(const Forms&, const auto&) const {}
};
template <class T>
std::vector<std::string> keys_of(const T& values) {
  std::vector<std::string> keys;
  if constexpr (IsForms<T>::value) {
    std::visit([&](const auto& form) { keys = keys_of(form); }, values);
  } else {
    ParametersOf<T>::parameters(values, KeyCollector{keys});
  }
  return keys;
}

/// Which of some forms is there, by their first keys; nothing, and a problem, where none is or several are. The last
/// form may have no key.
std::optional<std::size_t> form_given(const ConfigReader& from, const Forms& forms,
                                      const std::vector<std::vector<std::string>>& keys);

// Parts of it that no type changes.
void refuse_others(const ConfigReader& from, const Forms& forms, const std::vector<std::vector<std::string>>& keys,
                   std::size_t given);
bool whole(const ConfigReader& from, const char* key, const Allowed& allowed, const std::vector<double>& numbers);
bool is_map_or(const ConfigReader& from, const char* key, const std::string& word,
               const std::vector<std::string>& keys);
/// A name of a map whose names are whole numbers.
std::optional<std::uint64_t> number_of(const ConfigReader& from, const std::string& key, const Allowed& allowed,
                                       const std::string& name);

class ParameterReader {
 public:
  explicit ParameterReader(ConfigReader& from) : from_(from) {}

  template <class T>
  void operator()(const char* key, const char* unit, const Allowed& allowed, const char*, T& member) const {
    read(key, unit, allowed, member);
  }
  template <class T>
  void operator()(const char* key, const char*, T& member) const {
    read_structure(key, {}, member);
  }
  template <class T>
  void operator()(const Forms& forms, T& member) const {
    const std::vector<T> all = FormsOf<T>::all();
    std::vector<std::vector<std::string>> keys;
    for (const T& form : all) keys.push_back(keys_of(form));
    std::optional<std::size_t> given = member.index();
    if (*forms.key == '\0') {
      given = form_given(from_, forms, keys);
    } else {
      Allowed words = words_of<T>();
      words.required = forms.required;
      read_word(forms.key, words, [&](const Word& word) { given = static_cast<std::size_t>(word.value); });
      refuse_others(from_, forms, keys, *given);
    }
    if (!given || keys[*given].empty()) return;  // what there is without a key stays
    member = all[*given];
    std::visit([&](auto& form) { read_parameters(from_, form); }, member);
  }

 private:
  template <class T>
  void read(const char* key, const char* unit, const Allowed& allowed, T& member) const {
    if constexpr (ReadsItself<T>) {
      member.read(from_, key);
    } else if constexpr (Structure<T>) {
      read_structure(key, allowed, member);
    } else if constexpr (IsOptional<T>::value) {
      if (!allowed.instead.empty() && from_.holds_word(key, allowed.instead)) return member.reset();
      if constexpr (Structure<typename T::value_type>) return read_structure(key, allowed, member);
      else read_optional(key, unit, allowed, member);
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
  void read_optional(const char* key, const char* unit, const Allowed& allowed, std::optional<T>& member) const {
    if (!allowed.required && !from_.has(key)) return;
    T found{};
    const std::size_t before = from_.problem_count();
    read(key, unit, allowed, found);
    if (from_.problem_count() == before) member = std::move(found);
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
    } else if constexpr (IsWholes<T>::value) {
      std::vector<double> numbers;
      allowed.required ? from_.required(key, numbers, allowed.lo, allowed.hi)
                       : from_.optional(key, numbers, allowed.lo, allowed.hi);
      if (whole(from_, key, allowed, numbers) && from_.has(key)) member.assign(numbers.begin(), numbers.end());
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
    if (!allowed.instead.empty()) choices.emplace_back(allowed.instead, nullptr);  // taken already, but allowed
    for (const Word& word : allowed.words) choices.emplace_back(word.text, &word);
    const Word* found = nullptr;
    allowed.required ? from_.required_choice(key, found, choices) : from_.optional_choice(key, found, choices);
    if (found) set(*found);
  }

  template <class T>
  void read_structure(const char* key, const Allowed& allowed, T& member) const {
    if constexpr (IsOptional<T>::value) {
      using Value = typename T::value_type;
      if (!allowed.instead.empty() && !is_map_or(from_, key, allowed.instead, keys_of(Value{}))) return;
      if (auto section = from_.optional_section(key, short_key<Value>())) read_parameters(*section, member.emplace());
    } else if constexpr (MapOfParameters<T>) {
      read_map(key, allowed, member);
    } else if constexpr (ListOfParameters<T>) {
      using Entry = typename T::value_type;
      if (from_.has(key)) member.clear();
      if constexpr (NamedParameters<Entry>) {
        for (auto& [name, entry] : from_.named_sections(key, short_key<Entry>())) {
          Entry values{};
          values.*(Entry::kNamedBy) = name;
          read_parameters(entry, values);
          member.push_back(std::move(values));
        }
      } else {
        for (ConfigReader& entry : from_.list(key, short_key<Entry>())) {
          member.emplace_back();
          read_parameters(entry, member.back());
        }
      }
    } else if (allowed.required) {
      ConfigReader section = from_.section(key);
      read_parameters(section, member);
    } else if (auto section = from_.optional_section(key, short_key<T>())) {
      read_parameters(*section, member);
    }
  }

  /// What the file does not name stays.
  template <class T>
  void read_map(const char* key, const Allowed& allowed, T& member) const {
    using Entry = typename T::mapped_type;
    for (auto& [name, entry] : from_.named_sections(key, short_key<Entry>())) {
      Entry values{};
      read_parameters(entry, values);
      if constexpr (std::is_integral_v<typename T::key_type>) {
        const auto number = number_of(from_, key, allowed, name);
        if (number) member[static_cast<typename T::key_type>(*number)] = std::move(values);
      } else {
        member[name] = std::move(values);
      }
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
  if constexpr (requires { values.complete(from); }) values.complete(from);
}

/// The format at the head of a file, Of::kFormat.
template <class Of>
struct FormatKey {
  void read(ConfigReader& from, const char*) { read_format(from, Of::kFormat); }
  ConfigNode in_file() const { return ConfigNode::text(Of::kFormat); }
  static std::string schema() { return std::string(R"({"const": ")") + Of::kFormat + "\"}"; }
};

}  // namespace ensonify
