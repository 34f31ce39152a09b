#pragma once

#include <string>
#include <string_view>

namespace ensonify {

/// A text of somebody else's (a file, a process's last words, a message) as it may go to a terminal: control
/// characters, which could move the cursor or set colours, become \x1b and the like. Line ends and tabs stay, UTF-8
/// too; bytes that are none become \x and two digits.
std::string printable(std::string_view text);

/// Whether the bytes are UTF-8 as RFC 3629 has it.
bool is_utf8(std::string_view text);

}  // namespace ensonify
