#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "messages/fields.h"

namespace ensonify::msg {

/// Description of a message's field, read off the structs: the source of JSON Schemas, of the reference page and of
/// `ensonify describe`.
struct FieldInfo {
  enum class Kind { boolean, integer, number, text, array, fixed_list, list, map };

  std::string name;
  std::string unit;
  std::string about;
  Kind kind = Kind::map;
  Dtype dtype = Dtype::u8;         // array
  std::size_t length = 0;          // fixed_list
  std::vector<FieldInfo> members;  // map: its fields; fixed_list and list: one, the element
};

/// A message type with its fields.
struct TypeInfo {
  std::string type;   // "ping/1"
  std::string about;  // one sentence
  std::vector<FieldInfo> fields;
};

template <class T>
FieldInfo field_info(const char* name, const char* unit, const char* about) {
  using Kind = FieldInfo::Kind;
  FieldInfo info{name, unit, about, Kind::map, Dtype::u8, 0, {}};
  if constexpr (std::is_same_v<T, bool>) {
    info.kind = Kind::boolean;
  } else if constexpr (std::is_integral_v<T>) {
    info.kind = Kind::integer;
  } else if constexpr (std::is_floating_point_v<T>) {
    info.kind = Kind::number;
  } else if constexpr (std::is_same_v<T, std::string>) {
    info.kind = Kind::text;
  } else if constexpr (IsArray<T>::value) {
    info.kind = Kind::array;
    info.dtype = dtype_of<std::remove_cvref_t<decltype(std::declval<T>()[0])>>();
  } else if constexpr (IsFixed<T>::value) {
    info.kind = Kind::fixed_list;
    info.length = std::tuple_size_v<T>;
    info.members.push_back(field_info<typename T::value_type>("", "", ""));
  } else if constexpr (IsVector<T>::value) {
    info.kind = Kind::list;
    info.members.push_back(field_info<typename T::value_type>("", "", ""));
  } else {
    static_assert(HasFields<T>, "a field is a number, text, array, fixed array, vector or struct with fields()");
    T example;
    T::fields(example, [&](const char* n, const char* u, const char* a, auto& member) {
      info.members.push_back(field_info<std::remove_cvref_t<decltype(member)>>(n, u, a));
    });
  }
  return info;
}

template <Message M>
TypeInfo describe() {
  return {M::kType, M::kAbout, field_info<M>("", "", "").members};
}

/// Every message type of the project, in the order of messages/all.h.
const std::vector<TypeInfo>& message_types();
/// The type named, or null.
const TypeInfo* find_type(std::string_view type);

/// What is wrong with a value as a message of this type; "" when nothing is, or when the type is not known here.
std::string mistake_in(std::string_view type, const Value& value);

/// The type in words: "number", "number x 3", "f4 array", "text", "list of {name, count}".
std::string type_in_words(const FieldInfo& field);

/// JSON Schema of the type's map with its arrays inside (as in records), one line, the same in every run. "" for null.
std::string json_schema(const TypeInfo* type);

/// docs/manual/messages.md.
std::string reference_page();

}  // namespace ensonify::msg
