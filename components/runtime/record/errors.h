#pragma once

#include <stdexcept>
#include <string>

namespace ensonify::record {

/// A record that cannot be created or read: the user named a wrong file or folder. Exit code 2.
struct RecordError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Messages that should have been stored and are not (disk full, file size limit, I/O error). Exit code 5.
struct DataLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ensonify::record
