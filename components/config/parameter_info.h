#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/parameters.h"

/// What a parameter list says, as data: the default file, the table of a page and the schema are written from it.
namespace ensonify {

struct ParameterInfo {
  enum class Kind {
    kNumber,
    kInteger,
    kBool,
    kWord,
    kText,
    kNumbers,
    kWholes,
    kRows,
    kTexts,
    kSection,
    kList,
    kNamed,
    kForms,
    kOther
  };
  using List = std::vector<ParameterInfo>;

  std::string key;
  std::string unit;
  Allowed allowed;
  std::string about;
  Kind kind = Kind::kText;
  std::size_t width = 0;                    // of fixed lists and of rows
  bool left_out = false;                    // there is no default (required, computed or optional) or value
  bool optional = false;                    // a section that need not be there
  bool numbered = false;                    // a map whose names are whole numbers
  std::string short_key = {};               // a single value is short for the map with this key alone
  ConfigNode value = {};                    // the default, in the unit of the file
  std::vector<ParameterInfo> members = {};  // of a section, or of each entry of a list or map
  std::vector<List> forms = {};             // of kForms; its members are those of the form that is there
  bool last_has_no_key = false;             // of kForms: without a key it is the last form
  std::string by = {};                      // of kForms: the key whose word says which it is
  std::string schema = {};                  // of kOther: JSON Schema of the value
  std::vector<std::pair<std::string, List>> entries = {};  // that a list or map has by default, with their names
};

using ParameterList = ParameterInfo::List;

/// The list of a struct with these values for defaults. With `given`, the map from which they were read, the list is of
/// values: what is computed or empty counts where it was given.
template <class T>
ParameterList parameters_of(const T& values = T{}, const ConfigNode* given = nullptr);

/// A configuration file with every default, each with its sentence; `title` heads it as a comment.
std::string default_yaml(const std::string& title, const ParameterList& list);
/// What a file had, or could have had, to give these values: each with its sentence and unit, each line behind
/// `margin`. Of a list of values; one of none is "".
std::string written_yaml(const ParameterList& values, const std::string& margin = "");
/// A value as it stands, in lines behind `margin`: a map's keys, or a list's entries.
std::string block_yaml(const ConfigNode& node, const std::string& margin = "");
/// Whether one of the keys of a list, or of its forms, is this.
bool lists_key(const ParameterList& list, const std::string& key);
/// A Markdown table; keys of sections are written as section.key.
std::string parameter_table(const ParameterList& list);
/// JSON Schema (draft 2020-12) of the file.
std::string parameter_schema(const std::string& title, const ParameterList& list);

/// A schema as it is shipped: what stands in several places once, under `$defs`, and few lines.
std::string schema_text(const std::string& schema);

/// "0.05 to 10", "tone or chirp"; "" where everything is allowed.
std::string allowed_text(const ParameterInfo& parameter);

namespace detail {

/// With the working folder before it.
std::string absolute_path(const std::string& path);
/// The shortest decimal that, times the unit's factor, is the value again.
ConfigNode number_node(double value, double si_per_unit);
ConfigNode text_node(const std::string& text);
ConfigNode list_node();

/// How often T's list stands within itself.
template <class T>
inline thread_local int described_within = 0;

class DescribeParameters {
 public:
  explicit DescribeParameters(ParameterList& list, const ConfigNode* given = nullptr) : list_(list), given_(given) {}

  template <class T>
  void operator()(const char* key, const char* unit, const Allowed& allowed, const char* about, const T& member) {
    ParameterInfo& info = list_.emplace_back(ParameterInfo{key, unit, allowed, about});
    info.left_out =
        given_ ? allowed.again || (allowed.computed && !given_->find(key)) : allowed.required || allowed.computed;
    describe(info, member);
  }
  template <class T>
  void operator()(const char* key, const char* about, const T& member) {
    describe_structure(list_.emplace_back(ParameterInfo{key, "", any(), about}), member);
  }
  template <class T>
  void operator()(const Forms& forms, const T& member) {
    if (*forms.key != '\0') {
      Allowed words = words_of<T>();
      words.required = forms.required;
      ParameterInfo& kind = list_.emplace_back(ParameterInfo{forms.key, "", words, forms.about, Kind::kWord});
      kind.left_out = !given_ && forms.required;
      kind.value = text_node(words.words[member.index()].text);
    }
    ParameterInfo& info = list_.emplace_back(ParameterInfo{});
    info.kind = Kind::kForms;
    info.by = forms.key;
    info.last_has_no_key = forms.none.empty();
    for (const T& form : FormsOf<T>::all()) {
      info.forms.push_back(std::visit([](const auto& f) { return parameters_of(f); }, form));
    }
    info.members = std::visit([&](const auto& form) { return parameters_of(form, given_); }, member);
  }

 private:
  using Kind = ParameterInfo::Kind;

  template <class T>
  void describe(ParameterInfo& info, const T& member) {
    const double si = file_unit(info.unit.c_str());
    if constexpr (ReadsItself<T>) {
      info.kind = Kind::kOther;
      info.schema = T::schema();
      info.value = member.in_file();
      if (const ConfigNode* given = given_ ? given_->find(info.key) : nullptr; given && !given->is_null())
        info.value = *given;
    } else if constexpr (Structure<T>) {
      describe_structure(info, member);
    } else if constexpr (IsOptional<T>::value) {
      if constexpr (Structure<typename T::value_type>) return describe_structure(info, member);
      else describe_optional(info, member);
    } else if constexpr (std::is_same_v<T, std::string>) {
      info.kind = info.allowed.words.empty() ? Kind::kText : Kind::kWord;
      const bool is_path = given_ && info.allowed.text == Allowed::Text::kPath;
      info.value = text_node(is_path ? absolute_path(member) : member);
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
  void describe_optional(ParameterInfo& info, const std::optional<T>& member) {
    if constexpr (FixedVector<T>) describe(info, member.value_or(T::Zero()));
    else describe(info, member.value_or(T{}));
    if (member) return;
    if (info.allowed.instead.empty()) info.left_out = true;
    else info.value = text_node(info.allowed.instead);
  }

  template <class T>
  static void describe_list(ParameterInfo& info, const T& member, double si) {
    info.value = list_node();
    for (const auto& element : member) {
      if constexpr (std::is_same_v<T, std::vector<std::string>>) {
        info.value.items.push_back(text_node(element));
      } else if constexpr (IsWholes<T>::value) {
        info.value.items.push_back(ConfigNode::text(std::to_string(element)));
      } else if constexpr (IsNumbers<T>::value || FixedVector<T> || std::is_same_v<T, std::vector<double>>) {
        info.value.items.push_back(number_node(element, si));
      } else {
        ConfigNode& row = info.value.items.emplace_back(list_node());
        for (const double number : element) row.items.push_back(number_node(number, si));
      }
    }
    if constexpr (std::is_same_v<T, std::vector<std::string>>) {
      info.kind = Kind::kTexts;
    } else if constexpr (IsWholes<T>::value) {
      info.kind = Kind::kWholes;
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
  void describe_structure(ParameterInfo& info, const T& member) {
    const ConfigNode* given = given_ ? given_->find(info.key) : nullptr;
    static const ConfigNode kNothing;
    if (given_ && !given) given = &kNothing;
    if constexpr (IsOptional<T>::value) {
      info.kind = Kind::kSection;
      info.short_key = short_key<typename T::value_type>();
      info.optional = true;
      info.left_out = !member;
      info.members = parameters_of(member ? *member : typename T::value_type{}, given);
    } else if constexpr (MapOfParameters<T>) {
      info.kind = Kind::kNamed;
      info.numbered = std::is_integral_v<typename T::key_type>;
      info.short_key = short_key<typename T::mapped_type>();
      info.members = parameters_of<typename T::mapped_type>();
      for (const auto& [key, entry] : member) {
        std::string name;
        if constexpr (std::is_integral_v<typename T::key_type>) name = std::to_string(key);
        else name = key;
        const ConfigNode* of_entry = given ? given->find(name) : nullptr;
        info.entries.emplace_back(name, parameters_of(entry, given && !of_entry ? &kNothing : of_entry));
      }
      if (given_) info.left_out = member.empty() && !given_->find(info.key);
    } else if constexpr (ListOfParameters<T>) {
      describe_entries(info, member, given);
    } else {
      info.kind = Kind::kSection;
      info.short_key = short_key<T>();
      info.members = parameters_of(member, given);
    }
  }

  template <class T>
  void describe_entries(ParameterInfo& info, const T& member, const ConfigNode* given) {
    using Entry = typename T::value_type;
    constexpr int kDeepest = 2;  // lists of what they stand in
    if (described_within < Entry >> kDeepest && member.empty()) return list_.pop_back();
    ++described_within<Entry>;
    info.kind = NamedParameters<Entry> ? Kind::kNamed : Kind::kList;
    info.short_key = short_key<Entry>();
    info.members = parameters_of<Entry>();
    static const ConfigNode kNothing;
    for (std::size_t i = 0; i < member.size(); ++i) {
      std::string name;
      if constexpr (NamedParameters<Entry>) name = member[i].*Entry::kNamedBy;
      const ConfigNode* of_entry = nullptr;
      if (given)
        of_entry = NamedParameters<Entry> ? given->find(name) : i < given->items.size() ? &given->items[i] : nullptr;
      info.entries.emplace_back(std::move(name), parameters_of(member[i], given && !of_entry ? &kNothing : of_entry));
    }
    if (given_) info.left_out = member.empty() && !given_->find(info.key);
    --described_within<Entry>;
  }

  ParameterList& list_;
  const ConfigNode* given_;
};

}  // namespace detail

template <class T>
ParameterList parameters_of(const T& values, const ConfigNode* given) {
  ParameterList list;
  ParametersOf<T>::parameters(values, detail::DescribeParameters(list, given));
  return list;
}

}  // namespace ensonify
