#pragma once

#include <string>

#include "components/logger/config.h"
#include "messages/declarations.h"

/// Which files a class of instruments writes, and what they say of it.
namespace ensonify::logger {

/// Throws UserError where a format is none of the head's: Kongsberg's are written of an EM 2040, and of a generic head
/// of 200 to 400 kHz as if it were one. A declaration without a kind says nothing, and everything is allowed.
void check_instrument(const std::string& process, const LoggedFormats& formats, const std::string& head,
                      const msg::HeadDeclaration& declared);

/// Throws UserError where a ping has more soundings than Kongsberg's formats hold.
void check_soundings(const std::string& process, const LoggedFormats& formats, const std::string& head,
                     std::size_t soundings);

/// What files say of how they came to be: "simulated by Ensonify" and, of a generic head, that it is one. Without
/// commas.
std::string simulated_by(const std::string& instrument);

}  // namespace ensonify::logger
