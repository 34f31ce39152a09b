#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "messages/array.h"
#include "messages/value.h"

/// A message is a plain struct with one list of its fields:
///
///   template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
///     visit("stamp_ns", "ns", "transmission, sim time", self.stamp_ns);
///   }
///
/// Everything else (bytes, printing, schema, reference page) is derived from that list here.
namespace ensonify::msg {

// clang-format off
template <class T>
concept HasFields = requires(T& t) { T::fields(t, [](const char*, const char*, const char*, auto&) {}); };
template <class T>
concept Message = HasFields<T> && requires { { T::kType } -> std::convertible_to<const char*>; };

template <class T> struct IsArray : std::false_type {};
template <class T> struct IsArray<Array<T>> : std::true_type {};
template <class T> struct IsFixed : std::false_type {};
template <class T, std::size_t N> struct IsFixed<std::array<T, N>> : std::true_type {};
template <class T> struct IsVector : std::false_type {};
template <class T> struct IsVector<std::vector<T>> : std::true_type {};
// clang-format on

template <class T>
Value to_value(const T& member) {
  if constexpr (std::is_same_v<T, bool>) {
    return {member};
  } else if constexpr (std::is_unsigned_v<T>) {
    // One kind for every integer that fits, so that a value equals its decoded copy.
    if (std::in_range<std::int64_t>(member)) return {static_cast<std::int64_t>(member)};
    return {static_cast<std::uint64_t>(member)};
  } else if constexpr (std::is_integral_v<T>) {
    return {static_cast<std::int64_t>(member)};
  } else if constexpr (std::is_floating_point_v<T>) {
    return {static_cast<double>(member)};
  } else if constexpr (std::is_same_v<T, std::string>) {
    return {member};
  } else if constexpr (IsArray<T>::value) {
    using Element = std::remove_cvref_t<decltype(member[0])>;
    return {RawArray{dtype_of<Element>(), member.shape(), member.buffer()}};
  } else if constexpr (IsFixed<T>::value || IsVector<T>::value) {
    Value::List list;
    list.reserve(member.size());
    for (const auto& element : member) list.push_back(to_value(element));
    return {std::move(list)};
  } else {
    static_assert(HasFields<T>, "a field is a number, text, array, fixed array, vector or struct with fields()");
    Value::Map map;
    T::fields(member, [&](const char* name, const char*, const char*, const auto& field) {
      map.emplace_back(name, to_value(field));
    });
    return {std::move(map)};
  }
}

[[noreturn]] void wrong_type(const std::string& path, const char* wanted);

/// Fills `member` from `value`; throws DecodeError naming `path`. Keys that are not fields are ignored, fields without
/// a key keep what they hold.
template <class T>
void from_value(const Value& value, T& member, const std::string& path) {
  if constexpr (std::is_same_v<T, bool>) {
    if (const bool* b = value.as<bool>()) member = *b;
    else wrong_type(path, "a boolean");
  } else if constexpr (std::is_integral_v<T>) {
    const auto* i = value.as<std::int64_t>();
    const auto* u = value.as<std::uint64_t>();
    if (i && std::in_range<T>(*i)) member = static_cast<T>(*i);
    else if (u && std::in_range<T>(*u)) member = static_cast<T>(*u);
    else wrong_type(path, "an integer in range");
  } else if constexpr (std::is_floating_point_v<T>) {
    double number = 0.0;
    if (!value.number(number)) wrong_type(path, "a number");
    member = static_cast<T>(number);
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (const auto* s = value.as<std::string>()) member = *s;
    else wrong_type(path, "text");
  } else if constexpr (IsArray<T>::value) {
    using Element = std::remove_cvref_t<decltype(member[0])>;
    const auto* raw = value.as<RawArray>();
    if (!raw || raw->dtype != dtype_of<Element>()) wrong_type(path, dtype_name(dtype_of<Element>()));
    if (reinterpret_cast<std::uintptr_t>(raw->bytes.data) % alignof(Element) == 0) {
      member = T::view(raw->shape, raw->bytes.owner, reinterpret_cast<const Element*>(raw->bytes.data));
    } else {  // a frame may start anywhere; only then is a copy needed
      T copy(raw->shape);
      if (raw->bytes.size > 0) std::memcpy(copy.data(), raw->bytes.data, raw->bytes.size);
      member = std::move(copy);
    }
  } else if constexpr (IsFixed<T>::value) {
    const auto* list = value.as<Value::List>();
    if (!list || list->size() != member.size()) wrong_type(path, "a list of the declared length");
    for (std::size_t i = 0; i < member.size(); ++i) from_value((*list)[i], member[i], path + "." + std::to_string(i));
  } else if constexpr (IsVector<T>::value) {
    const auto* list = value.as<Value::List>();
    if (!list) wrong_type(path, "a list");
    member.assign(list->size(), {});
    for (std::size_t i = 0; i < member.size(); ++i) from_value((*list)[i], member[i], path + "." + std::to_string(i));
  } else {
    if (!value.as<Value::Map>()) wrong_type(path, "a map");
    T::fields(member, [&](const char* name, const char*, const char*, auto& field) {
      if (const Value* found = value.find(name)) from_value(*found, field, path.empty() ? name : path + "." + name);
    });
  }
}

/// Whether a field's or a type's text says that its numbers may be no numbers.
constexpr bool speaks_of_nan(std::string_view about) { return about.find("NaN") != std::string_view::npos; }

/// Name of the first field of a message with a number that is not finite though its text does not speak of NaN; "" when
/// there is none. Raw arrays are not looked into: they are large, and who uses their elements checks them.
template <class T>
std::string not_finite(const T& member, const char* name, bool allowed) {
  if constexpr (std::is_floating_point_v<T>) {
    return allowed || std::isfinite(member) ? "" : name;
  } else if constexpr (IsFixed<T>::value || IsVector<T>::value) {
    for (const auto& element : member) {
      if (auto field = not_finite(element, name, allowed); !field.empty()) return field;
    }
  } else if constexpr (HasFields<T>) {
    std::string first;
    T::fields(member, [&](const char* inner, const char*, const char* about, const auto& field) {
      if (!first.empty()) return;
      first = not_finite(field, inner, allowed || speaks_of_nan(about));
      if (!first.empty() && *name != '\0') first = std::string(name) + "." + first;
    });
    return first;
  }
  return "";
}
template <Message M>
std::string not_finite(const M& message) {
  return not_finite(message, "", speaks_of_nan(M::kAbout));
}

}  // namespace ensonify::msg
