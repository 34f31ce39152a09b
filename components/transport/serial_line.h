#pragma once

#include <chrono>
#include <string>

#include "components/transport/descriptor.h"

/// A serial line as both ways have it, in and out: eight bits, no parity, one stop bit, every byte as it comes.
namespace ensonify::serial {

inline constexpr std::chrono::seconds kTryAgain{1};

/// Throws UserError for a rate that serial lines do not have.
void check_baud(int baud);
/// Not open, and errno, where the line is not there.
Descriptor open(const std::string& path, int baud);
/// The same; throws UserError with what is allowed.
Descriptor must_open(const std::string& path, int baud);

}  // namespace ensonify::serial
