#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "messages/buffer.h"

namespace ensonify::msg {

enum class Dtype : std::uint8_t { u8, i16, u16, i32, u32, i64, f32, f64 };

/// Name on the wire (numpy's short form, little endian) and size of an element in bytes.
const char* dtype_name(Dtype dtype);
std::size_t dtype_size(Dtype dtype);
bool dtype_from_name(std::string_view name, Dtype& dtype);

template <class T>
constexpr Dtype dtype_of();
// clang-format off
template <> constexpr Dtype dtype_of<std::uint8_t>() { return Dtype::u8; }
template <> constexpr Dtype dtype_of<std::int16_t>() { return Dtype::i16; }
template <> constexpr Dtype dtype_of<std::uint16_t>() { return Dtype::u16; }
template <> constexpr Dtype dtype_of<std::int32_t>() { return Dtype::i32; }
template <> constexpr Dtype dtype_of<std::uint32_t>() { return Dtype::u32; }
template <> constexpr Dtype dtype_of<std::int64_t>() { return Dtype::i64; }
template <> constexpr Dtype dtype_of<float>() { return Dtype::f32; }
template <> constexpr Dtype dtype_of<double>() { return Dtype::f64; }
// clang-format on

/// An n-dimensional C-order array that travels as one raw frame. Copies share the elements, as in numpy: write before
/// you publish, never after. Received arrays are views of the received frame and must not be written.
template <class T>
class Array {
 public:
  Array() = default;

  /// Zero-filled.
  explicit Array(std::vector<std::size_t> shape) : shape_(std::move(shape)) {
    auto storage = std::make_shared<std::vector<T>>(count(shape_));
    data_ = storage->data();
    size_ = storage->size();
    owner_ = std::move(storage);
  }
  Array(std::initializer_list<std::size_t> shape) : Array(std::vector<std::size_t>(shape)) {}

  /// One-dimensional, taking over the values.
  static Array of(std::vector<T> values) {
    Array array;
    auto storage = std::make_shared<std::vector<T>>(std::move(values));
    array.shape_ = {storage->size()};
    array.data_ = storage->data();
    array.size_ = storage->size();
    array.owner_ = std::move(storage);
    return array;
  }

  /// A view of elements that `owner` keeps alive.
  static Array view(std::vector<std::size_t> shape, std::shared_ptr<const void> owner, const T* data) {
    Array array;
    array.size_ = count(shape);
    array.shape_ = std::move(shape);
    array.owner_ = std::move(owner);
    array.data_ = const_cast<T*>(data);
    return array;
  }

  const std::vector<std::size_t>& shape() const { return shape_; }
  std::size_t rows() const { return shape_.empty() ? 0 : shape_[0]; }
  std::size_t cols() const { return shape_.size() < 2 ? 0 : shape_[1]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  std::span<T> flat() { return {data_, size_}; }
  std::span<const T> flat() const { return {data_, size_}; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T& operator()(std::size_t row, std::size_t col) { return data_[row * shape_[1] + col]; }
  const T& operator()(std::size_t row, std::size_t col) const { return data_[row * shape_[1] + col]; }
  std::span<T> row(std::size_t i) { return {data_ + i * shape_[1], shape_[1]}; }
  std::span<const T> row(std::size_t i) const { return {data_ + i * shape_[1], shape_[1]}; }

  Buffer buffer() const { return {owner_, reinterpret_cast<const std::byte*>(data_), size_ * sizeof(T)}; }

  bool operator==(const Array& other) const {
    return shape_ == other.shape_ && std::equal(data_, data_ + size_, other.data_);
  }

 private:
  static std::size_t count(const std::vector<std::size_t>& shape) {
    std::size_t product = shape.empty() ? 0 : 1;
    for (const std::size_t extent : shape) product *= extent;
    return product;
  }

  std::vector<std::size_t> shape_;
  std::shared_ptr<const void> owner_;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace ensonify::msg
