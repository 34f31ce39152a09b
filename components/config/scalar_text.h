#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// Numbers and words as YAML scalars spell them.
namespace ensonify {

/// The whole of `text` as a decimal number; infinities and NaN (".inf", ".nan", "inf", "nan") come back as such.
std::optional<double> parse_number(const std::string& text);

/// The whole of `text` as a whole number, decimal or 0x hexadecimal.
std::optional<std::int64_t> parse_integer(const std::string& text);
std::optional<std::uint64_t> parse_natural(const std::string& text);

/// What a YAML reader makes of a bare word, by its own rules or those of YAML 1.1: nothing (null, ~), a truth value
/// (true, no, on) or a text. Every spelling counts: Null, NULL, nULL.
enum class BareWord { kText, kNull, kBool };
BareWord bare_word(const std::string& text);

/// "100000", "1e+06": as %g writes it when that is exact, else with as many digits as distinguish it from its
/// neighbours.
std::string shortest_number(double value);

}  // namespace ensonify
