#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/runtime/address_list.h"

namespace ensonify::bus {

/// Keys of a run whose sockets are on a network (CURVE, RFC 26), in ZeroMQ's text form. Whoever has them may take part,
/// from the addresses allowed; nobody else gets a byte.
struct Keys {
  std::string bound_public, bound_secret;          // of every socket that is bound
  std::string connected_public, connected_secret;  // of every socket that connects
  AddressList allowed;

  static Keys make(const std::vector<std::string>& allowed);
  /// A JSON file that its owner alone can read. Throw UserError.
  void write(const std::string& file) const;
  static Keys read(const std::string& file);
};

/// File of a run directory that holds its keys; there is none where the sockets are files themselves.
inline constexpr const char* kKeysFile = "keys.json";

/// Keys for an endpoint: of the file given, else of the run directory, or where that is not known of $ENSONIFY_KEYS;
/// none for `ipc://`, and none where there is no file.
std::optional<Keys> keys_for(const std::string& endpoint, const std::string& file, const std::string& run_dir);

}  // namespace ensonify::bus
