#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "components/formats/layout.h"

namespace ensonify::formats::kmall {

/// A part of text that states its own size.
struct TextPart {
  std::uint16_t info = 0;
  std::uint16_t status = 0;
  std::string text;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire.count(kU16, self.text, 6);  // with the count itself, info and status
    wire(self.info, self.status);
    wire.each(self.text);
  }
  bool operator==(const TextPart&) const = default;
};

/// Installation: groups NAME:KEY=value;KEY=value, separated by commas.
struct Installation : TextPart {
  static constexpr std::string_view kType = "#IIP";
  static constexpr std::uint8_t kVersion = 0;
  bool operator==(const Installation&) const = default;
};

/// Settings in force from this time on, as text.
struct Runtime : TextPart {
  static constexpr std::string_view kType = "#IOP";
  static constexpr std::uint8_t kVersion = 0;
  bool operator==(const Runtime&) const = default;
};

}  // namespace ensonify::formats::kmall
