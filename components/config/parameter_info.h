#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/parameters.h"

/// What a parameter list says, as data: the default file, the table of a page and the schema are written from it.
namespace ensonify {

struct ParameterInfo {
  enum class Kind { kNumber, kInteger, kBool, kWord, kText, kNumbers, kRows, kTexts, kSection, kList, kNamed, kOther };
  using List = std::vector<ParameterInfo>;

  std::string key;
  std::string unit;
  Allowed allowed;
  std::string about;
  Kind kind = Kind::kText;
  std::size_t width = 0;                                   // of fixed lists and of rows
  bool left_out = false;                                   // there is no default: required, computed or optional
  ConfigNode value = {};                                   // the default, in the unit of the file
  std::vector<ParameterInfo> members = {};                 // of a section, or of each entry of a list or map
  std::string schema = {};                                 // of kOther: JSON Schema of the value
  std::vector<std::pair<std::string, List>> entries = {};  // that a list or map has by default, with their names
};

using ParameterList = ParameterInfo::List;

/// The list of a struct with these values for defaults.
template <class T>
ParameterList parameters_of(const T& values = T{});

/// A configuration file with every default, each with its sentence; `title` heads it as a comment.
std::string default_yaml(const std::string& title, const ParameterList& list);
/// A Markdown table; keys of sections are written as section.key.
std::string parameter_table(const ParameterList& list);
/// JSON Schema (draft 2020-12) of the file.
std::string parameter_schema(const std::string& title, const ParameterList& list);

/// A JSON Schema of one map with these keys.
std::string object_schema(const ParameterList& list);

// What no struct holds: keys of sections whose reader is code.
ParameterInfo section_info(const std::string& key, const std::string& about, ParameterList members,
                           bool required = false);
ParameterInfo list_info(const std::string& key, const std::string& about, ParameterList members);
ParameterInfo named_info(const std::string& key, const std::string& about, ParameterList members);
ParameterInfo other_info(const std::string& key, const std::string& about, std::string schema, bool required = false);

/// "0.05 to 10", "tone or chirp"; "" where everything is allowed.
std::string allowed_text(const ParameterInfo& parameter);

namespace detail {

/// The shortest decimal that, times the unit's factor, is the value again.
ConfigNode number_node(double value, double si_per_unit);
ConfigNode text_node(const std::string& text);
ConfigNode list_node();

class DescribeParameters {
 public:
  explicit DescribeParameters(ParameterList& list) : list_(list) {}

  template <class T>
  void operator()(const char* key, const char* unit, const Allowed& allowed, const char* about, const T& member) {
    ParameterInfo& info = list_.emplace_back(ParameterInfo{key, unit, allowed, about});
    info.left_out = allowed.required || allowed.computed;
    describe(info, member);
  }
  template <class T>
  void operator()(const char* key, const char* about, const T& member) {
    ParameterInfo& info = list_.emplace_back(ParameterInfo{key, "", any(), about});
    describe_structure(info, member);
  }

 private:
  using Kind = ParameterInfo::Kind;

  template <class T>
  static void describe(ParameterInfo& info, const T& member) {
    const double si = file_unit(info.unit.c_str());
    if constexpr (ReadsItself<T>) {
      info.kind = Kind::kOther;
      info.schema = T::schema();
      info.value = member.in_file();
    } else if constexpr (IsOptional<T>::value) {
      describe(info, member.value_or(typename T::value_type{}));
      info.left_out = info.left_out || !member;
    } else if constexpr (std::is_same_v<T, std::string>) {
      info.kind = info.allowed.words.empty() ? Kind::kText : Kind::kWord;
      info.value = text_node(member);
    } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>) {
      info.kind = info.allowed.words.empty() ? Kind::kBool : Kind::kWord;
      info.value = ConfigNode::text(static_cast<bool>(member) ? "true" : "false");
      for (const Word& word : info.allowed.words) {
        if (word.value == static_cast<std::int64_t>(member)) info.value = text_node(word.text);
      }
    } else if constexpr (std::is_integral_v<T>) {
      info.kind = Kind::kInteger;
      info.value = ConfigNode::text(std::to_string(member));
    } else if constexpr (std::is_floating_point_v<T>) {
      info.kind = Kind::kNumber;
      info.value = number_node(member, si);
    } else {
      describe_list(info, member, si);
    }
  }

  template <class T>
  static void describe_list(ParameterInfo& info, const T& member, double si) {
    info.value = list_node();
    for (const auto& element : member) {
      if constexpr (std::is_same_v<T, std::vector<std::string>>) {
        info.value.items.push_back(text_node(element));
      } else if constexpr (IsNumbers<T>::value || FixedVector<T> || std::is_same_v<T, std::vector<double>>) {
        info.value.items.push_back(number_node(element, si));
      } else {
        ConfigNode& row = info.value.items.emplace_back(list_node());
        for (const double number : element) row.items.push_back(number_node(number, si));
      }
    }
    if constexpr (std::is_same_v<T, std::vector<std::string>>) {
      info.kind = Kind::kTexts;
    } else if constexpr (IsNumbers<T>::value || FixedVector<T>) {
      info.kind = Kind::kNumbers;
      info.width = static_cast<std::size_t>(member.size());
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      info.kind = Kind::kNumbers;
    } else {
      info.kind = Kind::kRows;
      if constexpr (FixedVectors<T>) info.width = static_cast<std::size_t>(T::value_type::SizeAtCompileTime);
      else info.width = std::tuple_size_v<typename T::value_type>;
    }
  }

  template <class T>
  static void describe_structure(ParameterInfo& info, const T& member) {
    if constexpr (IsOptional<T>::value) {
      describe_structure(info, member ? *member : typename T::value_type{});
      info.left_out = !member;
    } else if constexpr (ListOfParameters<T>) {
      using Entry = typename T::value_type;
      info.kind = NamedParameters<Entry> ? Kind::kNamed : Kind::kList;
      info.members = parameters_of<Entry>();
      for (const Entry& entry : member) {
        std::string name;
        if constexpr (NamedParameters<Entry>) name = entry.*Entry::kNamedBy;
        info.entries.emplace_back(std::move(name), parameters_of(entry));
      }
    } else {
      info.kind = Kind::kSection;
      info.members = parameters_of(member);
    }
  }

  ParameterList& list_;
};

}  // namespace detail

template <class T>
ParameterList parameters_of(const T& values) {
  ParameterList list;
  ParametersOf<T>::parameters(values, detail::DescribeParameters(list));
  return list;
}

}  // namespace ensonify
