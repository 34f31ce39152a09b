#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "messages/array.h"
#include "messages/buffer.h"

namespace ensonify::msg {

/// Bytes that are not a message of the expected kind. The text names the field.
struct DecodeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A raw array inside a message: element type, shape and bytes, without a C++ type.
struct RawArray {
  Dtype dtype = Dtype::u8;
  std::vector<std::size_t> shape;
  Buffer bytes;

  std::size_t size() const { return bytes.size / dtype_size(dtype); }
  /// Element i in C order, whatever the type. i < size().
  double number(std::size_t i) const;
};

struct MapEntry;

/// A message without its C++ type: what tools print, compare and check. A map keeps the order of its keys.
struct Value {
  using List = std::vector<Value>;
  using Map = std::vector<MapEntry>;
  std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, List, Map, RawArray> is;

  /// The value as T, or null if it is something else.
  template <class T>
  const T* as() const;
  /// The value under `key`, or null if this is no map or has no such key.
  const Value* find(std::string_view key) const;
  /// The value at a path such as "position_enu_m.0" or "counters.late_tile"; null if there is none.
  const Value* at(std::string_view path) const;
  /// Any number as double; false if this is no number.
  bool number(double& out) const;
};

/// One key of a map and what stands under it. (A std::pair of an incomplete type does not compile with clang 14.)
struct MapEntry {
  MapEntry(std::string key, Value value) : first(std::move(key)), second(std::move(value)) {}
  std::string first;
  Value second;
};

template <class T>
const T* Value::as() const {
  return std::get_if<T>(&is);
}

bool operator==(const Value& a, const Value& b);
inline bool operator!=(const Value& a, const Value& b) { return !(a == b); }
inline bool operator==(const MapEntry& a, const MapEntry& b) { return a.first == b.first && a.second == b.second; }

/// JSON text. Arrays longer than `max_elements` are shown as {"dtype","shape","min","max"}; NaN and infinities as
/// strings.
std::string to_json(const Value& value, std::size_t max_elements = 16);

/// The value that JSON text says, without arrays. Throws DecodeError for what is no JSON, or nested deeper than
/// kMaxDepth.
Value from_json(std::string_view text);

}  // namespace ensonify::msg
