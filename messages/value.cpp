#include "messages/value.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "messages/fields.h"

namespace ensonify::msg {

namespace {

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

void append_text(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      (out += '\\') += c;
    } else if (byte < 0x20) {
      constexpr char kHex[] = "0123456789abcdef";
      ((out += "\\u00") += kHex[byte >> 4]) += kHex[byte & 15];
    } else {
      out += c;
    }
  }
  out += '"';
}

void append_number(std::string& out, double number) {
  if (std::isnan(number)) {
    out += "\"nan\"";
  } else if (std::isinf(number)) {
    out += number > 0 ? "\"inf\"" : "\"-inf\"";
  } else {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, number);
    out.append(text, end.ptr);
  }
}

template <class T>
T element(const RawArray& array, std::size_t i) {
  T value;
  std::memcpy(&value, array.bytes.data + i * sizeof(T), sizeof(T));
  return value;
}

void append_array(std::string& out, const RawArray& array, std::size_t max_elements) {
  const std::size_t count = array.size();
  if (count <= max_elements) {
    out += '[';
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) out += ',';
      append_number(out, array.number(i));
    }
    out += ']';
    return;
  }
  double low = INFINITY;
  double high = -INFINITY;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = array.number(i);
    low = std::fmin(low, value);
    high = std::fmax(high, value);
  }
  ((out += "{\"dtype\":\"") += dtype_name(array.dtype)) += "\",\"shape\":[";
  for (std::size_t i = 0; i < array.shape.size(); ++i) (out += i > 0 ? "," : "") += std::to_string(array.shape[i]);
  out += "],\"min\":";
  append_number(out, low);
  out += ",\"max\":";
  append_number(out, high);
  out += '}';
}

void append_json(std::string& out, const Value& value, std::size_t max_elements) {
  if (const auto* map = value.as<Value::Map>()) {
    out += '{';
    for (std::size_t i = 0; i < map->size(); ++i) {
      if (i > 0) out += ',';
      append_text(out, (*map)[i].first);
      out += ':';
      append_json(out, (*map)[i].second, max_elements);
    }
    out += '}';
  } else if (const auto* list = value.as<Value::List>()) {
    out += '[';
    for (std::size_t i = 0; i < list->size(); ++i) {
      if (i > 0) out += ',';
      append_json(out, (*list)[i], max_elements);
    }
    out += ']';
  } else if (const auto* array = value.as<RawArray>()) {
    append_array(out, *array, max_elements);
  } else if (const auto* text = value.as<std::string>()) {
    append_text(out, *text);
  } else if (const auto* boolean = value.as<bool>()) {
    out += *boolean ? "true" : "false";
  } else if (const auto* integer = value.as<std::int64_t>()) {
    out += std::to_string(*integer);
  } else if (const auto* large = value.as<std::uint64_t>()) {
    out += std::to_string(*large);
  } else if (const auto* number = value.as<double>()) {
    append_number(out, *number);
  } else {
    out += "null";
  }
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

std::string to_json(const Value& value, std::size_t max_elements) {
  std::string out;
  append_json(out, value, max_elements);
  return out;
}

void wrong_type(const std::string& path, const char* wanted) { throw DecodeError(path + ": is not " + wanted); }

}  // namespace ensonify::msg
