#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "components/errors/exit_error.h"

namespace ensonify {

/// A message that its publisher should not have sent so. The text names sender, topic, seq and field.
inline PeerError broken_message(const std::string& publisher, const std::string& topic, std::uint64_t seq,
                                const std::string& what) {
  return {kExitDied, publisher,
          fmt::format("{} sent a message that cannot be used: {}: seq {}: {}", publisher, topic, seq, what)};
}

/// Messages that never came.
inline PeerError lost_messages(const std::string& publisher, const std::string& topic, std::uint64_t due,
                               std::uint64_t came) {
  return {kExitDataLost, publisher,
          fmt::format("{} lost messages: {}: seq {} is missing, {} came", publisher, topic, due, came)};
}

}  // namespace ensonify
