#pragma once

#include <cstddef>
#include <utility>
#include <variant>

#include "components/formats/layout.h"
#include "components/formats/raw.h"

namespace ensonify::formats {

enum class Decoded { unknown, known, malformed };

/// Fills `body` with the alternative of the variant for which `wanted(type)` holds (called with a std::type_identity),
/// and `rest` with the bytes behind its layout. Without one, or where the bytes are not of its layout: with Raw, the
/// first alternative. `prepare` sets what the layout needs and the bytes do not have.
template <class Body, class Wanted, class Prepare>
Decoded decode(ByteView bytes, Body& body, Bytes& rest, Wanted&& wanted, Prepare&& prepare) {
  Decoded result = Decoded::unknown;
  rest.clear();
  const auto try_one = [&]<class One>(std::type_identity<One> type) {
    if constexpr (!std::is_same_v<One, Raw>) {
      if (!wanted(type)) return false;
      LayoutReader in(bytes);
      One value;
      prepare(value);
      in(value);
      result = in.failed() ? Decoded::malformed : Decoded::known;
      if (in.failed()) return true;
      body = std::move(value);
      rest.assign(in.left().begin(), in.left().end());
      return true;
    } else {
      return false;
    }
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    static_cast<void>((try_one(std::type_identity<std::variant_alternative_t<I, Body>>{}) || ...));
  }
  (std::make_index_sequence<std::variant_size_v<Body>>{});
  if (result != Decoded::known) body = Raw{Bytes(bytes.begin(), bytes.end())};
  return result;
}

template <class Body, class Wanted>
Decoded decode(ByteView bytes, Body& body, Bytes& rest, Wanted&& wanted) {
  return decode(bytes, body, rest, wanted, [](auto&) {});
}

/// Appends a body.
template <class Body>
void encode(const Body& body, Bytes& out) {
  std::visit(
      [&]<class One>(const One& one) {
        if constexpr (std::is_same_v<One, Raw>) {
          out.insert(out.end(), one.bytes.begin(), one.bytes.end());
        } else {
          LayoutWriter wire(out);
          wire(one);
        }
      },
      body);
}

}  // namespace ensonify::formats
