#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "components/transport/channel.h"
#include "components/transport/descriptor.h"

/// Connections as both ways have them, in and out.
namespace ensonify::tcp {

/// After a connection could not be made.
inline constexpr std::chrono::seconds kTryAgain{1};

/// Throws UserError with what is allowed.
Descriptor listener(const std::string& address, int port);

/// A connection that somebody has made to the listener: not open where nobody has. `allowed`: whether it may.
struct Accepted {
  Descriptor connection;
  bool allowed = false;
};
Accepted accept(const Descriptor& listener, const Senders& allowed);

/// Not open where none can be made within the time.
Descriptor connect(const Address& address, std::chrono::milliseconds limit);

}  // namespace ensonify::tcp
