#include "messages/value.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "messages/codec.h"
#include "messages/fields.h"

namespace ensonify::msg {

namespace {

using Json = nlohmann::ordered_json;

struct DtypeFacts {
  Dtype dtype;
  const char* name;
  std::size_t size;
};
constexpr DtypeFacts kDtypes[] = {{Dtype::u8, "u1", 1},  {Dtype::i16, "i2", 2}, {Dtype::u16, "u2", 2},
                                  {Dtype::i32, "i4", 4}, {Dtype::u32, "u4", 4}, {Dtype::i64, "i8", 8},
                                  {Dtype::f32, "f4", 4}, {Dtype::f64, "f8", 8}};

bool same_raw(const RawArray& a, const RawArray& b) {
  return a.dtype == b.dtype && a.shape == b.shape && same_bytes(a.bytes, b.bytes);
}

/// A number as JSON; what is not finite as text, since JSON has none.
Json json_of(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  if (number == std::trunc(number) && std::abs(number) < 1e15) return static_cast<std::int64_t>(number);
  return number;
}

template <class T>
T element(const RawArray& array, std::size_t i) {
  T value;
  std::memcpy(&value, array.bytes.data + i * sizeof(T), sizeof(T));
  return value;
}

Json json_of(const RawArray& array, std::size_t max_elements) {
  const std::size_t count = array.size();
  if (count <= max_elements) {
    Json all = Json::array();
    for (std::size_t i = 0; i < count; ++i) all.push_back(json_of(array.number(i)));
    return all;
  }
  double low = INFINITY;
  double high = -INFINITY;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = array.number(i);
    low = std::fmin(low, value);
    high = std::fmax(high, value);
  }
  return {{"dtype", dtype_name(array.dtype)}, {"shape", array.shape}, {"min", json_of(low)}, {"max", json_of(high)}};
}

Json json_of(const Value& value, std::size_t max_elements) {
  if (const auto* map = value.as<Value::Map>()) {
    Json object = Json::object();
    for (const auto& [key, member] : *map) object[key] = json_of(member, max_elements);
    return object;
  }
  if (const auto* list = value.as<Value::List>()) {
    Json items = Json::array();
    for (const Value& item : *list) items.push_back(json_of(item, max_elements));
    return items;
  }
  if (const auto* array = value.as<RawArray>()) return json_of(*array, max_elements);
  if (const auto* text = value.as<std::string>()) return *text;
  if (const auto* boolean = value.as<bool>()) return *boolean;
  if (const auto* integer = value.as<std::int64_t>()) return *integer;
  if (const auto* large = value.as<std::uint64_t>()) return *large;
  if (const auto* number = value.as<double>()) return json_of(*number);
  return nullptr;
}

Value value_of(const Json& json, std::size_t depth) {
  if (depth > kMaxDepth) throw DecodeError("is nested deeper than " + std::to_string(kMaxDepth));
  if (json.is_object()) {
    Value::Map map;
    for (const auto& [key, member] : json.items()) map.emplace_back(key, value_of(member, depth + 1));
    return {std::move(map)};
  }
  if (json.is_array()) {
    Value::List list;
    for (const Json& item : json) list.push_back(value_of(item, depth + 1));
    return {std::move(list)};
  }
  if (json.is_string()) return {json.get<std::string>()};
  if (json.is_boolean()) return {json.get<bool>()};
  if (json.is_number_float()) return {json.get<double>()};
  if (json.is_number_integer()) {
    const bool fits = !json.is_number_unsigned() || std::in_range<std::int64_t>(json.get<std::uint64_t>());
    return fits ? Value{json.get<std::int64_t>()} : Value{json.get<std::uint64_t>()};
  }
  return {};
}

}  // namespace

double RawArray::number(std::size_t i) const {
  switch (dtype) {
    case Dtype::u8: return element<std::uint8_t>(*this, i);
    case Dtype::i16: return element<std::int16_t>(*this, i);
    case Dtype::u16: return element<std::uint16_t>(*this, i);
    case Dtype::i32: return element<std::int32_t>(*this, i);
    case Dtype::u32: return element<std::uint32_t>(*this, i);
    case Dtype::i64: return static_cast<double>(element<std::int64_t>(*this, i));
    case Dtype::f32: return element<float>(*this, i);
    case Dtype::f64: return element<double>(*this, i);
  }
  return 0.0;
}

const char* dtype_name(Dtype dtype) { return kDtypes[static_cast<std::size_t>(dtype)].name; }
std::size_t dtype_size(Dtype dtype) { return kDtypes[static_cast<std::size_t>(dtype)].size; }
bool dtype_from_name(std::string_view name, Dtype& dtype) {
  const auto* found =
      std::find_if(std::begin(kDtypes), std::end(kDtypes), [&](const auto& d) { return name == d.name; });
  if (found == std::end(kDtypes)) return false;
  dtype = found->dtype;
  return true;
}

const Value* Value::find(std::string_view key) const {
  const auto* map = as<Map>();
  if (!map) return nullptr;
  const auto found = std::find_if(map->begin(), map->end(), [&](const auto& entry) { return entry.first == key; });
  return found == map->end() ? nullptr : &found->second;
}

const Value* Value::at(std::string_view path) const {
  const Value* here = this;
  while (here && !path.empty()) {
    const std::size_t dot = path.find('.');
    const std::string_view step = path.substr(0, dot);
    path = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
    if (const auto* list = here->as<List>()) {
      std::size_t index = 0;
      const auto parsed = std::from_chars(step.data(), step.data() + step.size(), index);
      const bool good = parsed.ec == std::errc{} && parsed.ptr == step.data() + step.size() && index < list->size();
      here = good ? &(*list)[index] : nullptr;
    } else {
      here = here->find(step);
    }
  }
  return here;
}

bool Value::number(double& out) const {
  if (const auto* d = as<double>()) out = *d;
  else if (const auto* i = as<std::int64_t>()) out = static_cast<double>(*i);
  else if (const auto* u = as<std::uint64_t>()) out = static_cast<double>(*u);
  else return false;
  return true;
}

bool operator==(const Value& a, const Value& b) {
  if (a.is.index() != b.is.index()) return false;
  if (const auto* number = a.as<double>()) {  // by bits: a NaN equals itself, and -0 is not 0
    return std::bit_cast<std::uint64_t>(*number) == std::bit_cast<std::uint64_t>(*b.as<double>());
  }
  if (const auto* array = a.as<RawArray>()) return same_raw(*array, *b.as<RawArray>());
  if (const auto* list = a.as<Value::List>()) return *list == *b.as<Value::List>();
  if (const auto* map = a.as<Value::Map>()) return *map == *b.as<Value::Map>();
  if (const auto* text = a.as<std::string>()) return *text == *b.as<std::string>();
  if (const auto* boolean = a.as<bool>()) return *boolean == *b.as<bool>();
  if (const auto* integer = a.as<std::int64_t>()) return *integer == *b.as<std::int64_t>();
  if (const auto* large = a.as<std::uint64_t>()) return *large == *b.as<std::uint64_t>();
  return true;
}

Value from_json(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw DecodeError("is no JSON");
  return value_of(json, 0);
}

std::string to_json(const Value& value, std::size_t max_elements) {
  return json_of(value, max_elements).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void wrong_type(const std::string& path, const char* wanted) { throw DecodeError(path + ": is not " + wanted); }

}  // namespace ensonify::msg
