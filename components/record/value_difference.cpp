#include "components/record/value_difference.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "messages/codec.h"

namespace ensonify::record {
namespace {

using msg::Value;

template <class T>
std::string number_text(const std::byte* at) {
  T number;
  std::memcpy(&number, at, sizeof number);
  if constexpr (std::is_floating_point_v<T>) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    if (std::isnan(number)) {  // of which there are many
      char bits[17] = {};
      std::to_chars(bits, bits + 16, std::bit_cast<Bits>(number), 16);
      return "nan (0x" + std::string(bits) + ")";
    }
  }
  char text[32] = {};
  std::to_chars(text, text + sizeof text, number);  // as many digits as distinguish it from its neighbours
  return text;
}

std::string element_text(const msg::RawArray& array, std::size_t index) {
  const std::byte* at = array.bytes.data + index * msg::dtype_size(array.dtype);
  switch (array.dtype) {
    case msg::Dtype::u8: return number_text<std::uint8_t>(at);
    case msg::Dtype::i16: return number_text<std::int16_t>(at);
    case msg::Dtype::u16: return number_text<std::uint16_t>(at);
    case msg::Dtype::i32: return number_text<std::int32_t>(at);
    case msg::Dtype::u32: return number_text<std::uint32_t>(at);
    case msg::Dtype::i64: return number_text<std::int64_t>(at);
    case msg::Dtype::f32: return number_text<float>(at);
    case msg::Dtype::f64: return number_text<double>(at);
  }
  return "";
}

std::string shape_text(const msg::RawArray& array) {
  std::string text = msg::dtype_name(array.dtype);
  for (std::size_t i = 0; i < array.shape.size(); ++i) text += (i == 0 ? "[" : ",") + std::to_string(array.shape[i]);
  return text + (array.shape.empty() ? "[]" : "]");
}

std::string index_text(std::size_t flat, const std::vector<std::size_t>& shape) {
  std::string text;
  for (std::size_t axis = shape.size(); axis-- > 0; flat /= shape[axis]) {
    text = std::to_string(flat % shape[axis]) + (text.empty() ? "" : ",") + text;
  }
  return "[" + text + "]";
}

std::string text_of(const Value& value) {
  if (const auto* number = value.as<double>()) return number_text<double>(reinterpret_cast<const std::byte*>(number));
  return to_json(value);
}

std::string join(const std::string& path, const std::string& step) { return path.empty() ? step : path + "." + step; }

std::optional<ValueDifference> difference(const Value& a, const Value& b, const std::string& path);

std::optional<ValueDifference> array_difference(const msg::RawArray& a, const msg::RawArray& b,
                                                const std::string& path) {
  if (a.dtype != b.dtype || a.shape != b.shape) return ValueDifference{path, shape_text(a), shape_text(b)};
  const auto bytes = a.bytes.bytes();
  const auto differ = std::mismatch(bytes.begin(), bytes.end(), b.bytes.data);
  if (differ.first == bytes.end()) return std::nullopt;
  const std::size_t index = static_cast<std::size_t>(differ.first - bytes.begin()) / msg::dtype_size(a.dtype);
  return ValueDifference{path + index_text(index, a.shape), element_text(a, index), element_text(b, index)};
}

std::optional<ValueDifference> map_difference(const Value& a, const Value& b, const std::string& path) {
  for (const msg::MapEntry& entry : *a.as<Value::Map>()) {
    const Value* other = b.find(entry.first);
    if (!other) return ValueDifference{join(path, entry.first), text_of(entry.second), "missing"};
    if (auto found = difference(entry.second, *other, join(path, entry.first))) return found;
  }
  for (const msg::MapEntry& entry : *b.as<Value::Map>()) {
    if (!a.find(entry.first)) return ValueDifference{join(path, entry.first), "missing", text_of(entry.second)};
  }
  return std::nullopt;
}

std::optional<ValueDifference> list_difference(const Value::List& a, const Value::List& b, const std::string& path) {
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const std::string here = join(path, std::to_string(i));
    if (i >= b.size()) return ValueDifference{here, text_of(a[i]), "missing"};
    if (i >= a.size()) return ValueDifference{here, "missing", text_of(b[i])};
    if (auto found = difference(a[i], b[i], here)) return found;
  }
  return std::nullopt;
}

std::optional<ValueDifference> difference(const Value& a, const Value& b, const std::string& path) {
  if (a == b) return std::nullopt;
  if (a.as<Value::Map>() && b.as<Value::Map>()) return map_difference(a, b, path);
  if (a.as<Value::List>() && b.as<Value::List>()) {
    return list_difference(*a.as<Value::List>(), *b.as<Value::List>(), path);
  }
  if (a.as<msg::RawArray>() && b.as<msg::RawArray>()) {
    return array_difference(*a.as<msg::RawArray>(), *b.as<msg::RawArray>(), path);
  }
  return ValueDifference{path, text_of(a), text_of(b)};
}

}  // namespace

std::optional<ValueDifference> first_difference(const Value& a, const Value& b) { return difference(a, b, ""); }

}  // namespace ensonify::record
