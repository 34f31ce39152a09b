#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "components/errors/assert.h"
#include "components/formats/bytes.h"
#include "components/formats/fixed_point.h"

/// What stands in a datagram, in order, is written once:
///
///   template <class Self, class Wire> static void layout(Self& self, Wire&& wire) {
///     wire(self.depth_m, self.quality);
///     wire.count(kU16, self.beams);  // how many there are; the list follows later
///     wire(self.spare);
///     wire.each(self.beams);
///   }
///
/// Reading, writing and the number of bytes follow from that list, so that they cannot disagree. `wire` is one of the
/// three classes below. Fields are numbers, FixedPoint, std::array of these, and structs that have a layout.
namespace ensonify::formats {

// Width of a count or a length in the file.
inline constexpr std::type_identity<std::uint8_t> kU8;
inline constexpr std::type_identity<std::uint16_t> kU16;
inline constexpr std::type_identity<std::uint32_t> kU32;

template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t N>
inline constexpr bool kIsArray<std::array<T, N>> = true;
template <class T>
inline constexpr bool kIsFixedPoint = false;
template <class Count, int Steps, int Units>
inline constexpr bool kIsFixedPoint<FixedPoint<Count, Steps, Units>> = true;

/// Goes through a field down to its numbers.
template <class Wire, class Field>
void visit_field(Wire& wire, Field& field) {
  using Plain = std::remove_const_t<Field>;
  if constexpr (std::is_arithmetic_v<Plain>) {
    wire.number(field);
  } else if constexpr (kIsFixedPoint<Plain>) {
    wire.number(field.count);
  } else if constexpr (kIsArray<Plain>) {
    for (auto& element : field) visit_field(wire, element);
  } else {
    Plain::layout(field, wire);
  }
}

/// Counts the bytes of what is always there; lists count as empty.
class LayoutSize {
 public:
  template <class... Fields>
  void operator()(Fields&... fields) {
    (visit_field(*this, fields), ...);
  }
  template <class Number>
  void number(const Number&) {
    bytes_ += sizeof(Number);
  }
  template <class Count, class List>
  void count(std::type_identity<Count>, const List&, std::size_t = 0) {
    bytes_ += sizeof(Count);
  }
  template <class Number>
  void constant(Number) {
    bytes_ += sizeof(Number);
  }
  template <class List>
  void each(const List&) {}
  template <class List>
  void rest(const List&) {}
  template <class List>
  void resize(const List&, std::uint64_t) {}
  std::size_t bytes() const { return bytes_; }

 private:
  std::size_t bytes_ = 0;
};

/// Bytes of a T with empty lists; those of every T that has none.
template <class T>
std::size_t fixed_bytes() {
  static const std::size_t bytes = [] {
    LayoutSize size;
    const T value{};
    size(value);
    return size.bytes();
  }();
  return bytes;
}

/// Fills structs from bytes. A list is made only where the bytes left can hold it, so memory is bounded by the file.
class LayoutReader {
 public:
  explicit LayoutReader(ByteView bytes) : in_(bytes) {}

  template <class... Fields>
  void operator()(Fields&... fields) {
    (visit_field(*this, fields), ...);
  }
  template <class Number>
  void number(Number& field) {
    field = in_.number<Number>();
  }
  /// `besides`: what the count counts more than the list's entries.
  template <class Count, class List>
  void count(std::type_identity<Count>, List& list, std::size_t besides = 0) {
    const std::uint64_t counted = in_.number<Count>();
    if (counted < besides) in_.fail();
    resize(list, in_.failed() ? 0 : counted - besides);
  }
  /// A number that is the same in every file of this layout; another one: the layout is not this one.
  template <class Number>
  void constant(Number wanted) {
    if (in_.number<Number>() != wanted) in_.fail();
  }
  template <class List>
  void each(List& list) {
    using Element = typename List::value_type;
    if constexpr (std::is_arithmetic_v<Element> || std::is_same_v<Element, std::byte>) {
      const ByteView taken = in_.take(list.size() * sizeof(Element));
      if (!taken.empty()) std::memcpy(list.data(), taken.data(), taken.size());
    } else {
      for (auto& element : list) visit_field(*this, element);
    }
  }
  /// Everything up to the end.
  void rest(std::string& text) {
    const ByteView taken = in_.take(in_.left().size());
    text.assign(reinterpret_cast<const char*>(taken.data()), taken.size());
  }
  /// As many as a field read before says.
  template <class List>
  void resize(List& list, std::uint64_t elements) {
    using Element = typename List::value_type;
    const std::size_t least = element_bytes<Element>();
    if (elements > in_.left().size() / least) {
      in_.fail();
      elements = 0;
    }
    list.resize(static_cast<std::size_t>(elements));
  }

  bool failed() const { return in_.failed(); }
  ByteView left() const { return in_.left(); }

 private:
  template <class Element>
  static std::size_t element_bytes() {
    if constexpr (std::is_same_v<Element, std::byte>) return 1;
    else return std::max<std::size_t>(fixed_bytes<Element>(), 1);
  }

  ByteSource in_;
};

/// Appends structs to bytes.
class LayoutWriter {
 public:
  explicit LayoutWriter(Bytes& out) : out_(out) {}

  template <class... Fields>
  void operator()(Fields&... fields) {
    (visit_field(*this, fields), ...);
  }
  template <class Number>
  void number(const Number& field) {
    append_number(out_, field);
  }
  template <class Count, class List>
  void count(std::type_identity<Count>, const List& list, std::size_t besides = 0) {
    const std::size_t counted = list.size() + besides;
    ENSONIFY_ASSERT(counted <= std::numeric_limits<Count>::max(),
                    std::to_string(list.size()) + " entries in a list whose count ends at " +
                        std::to_string(std::numeric_limits<Count>::max()));
    append_number(out_, static_cast<Count>(counted));
  }
  template <class Number>
  void constant(Number value) {
    append_number(out_, value);
  }
  template <class List>
  void each(const List& list) {
    using Element = typename List::value_type;
    if constexpr (std::is_arithmetic_v<Element> || std::is_same_v<Element, std::byte>) {
      const auto* first = reinterpret_cast<const std::byte*>(list.data());
      out_.insert(out_.end(), first, first + list.size() * sizeof(Element));
    } else {
      for (const auto& element : list) visit_field(*this, element);
    }
  }
  void rest(const std::string& text) { each(text); }
  template <class List>
  void resize(const List&, std::uint64_t) {}

 private:
  Bytes& out_;
};

}  // namespace ensonify::formats
