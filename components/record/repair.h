#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "components/runtime/sim_time.h"

namespace ensonify::record {

/// What a repair found and did.
struct Repair {
  bool was_whole = false;           // nothing was changed
  std::uint64_t messages = 0;       // in the record now
  std::optional<SimTime> last;      // time of the last of them
  std::uint64_t kept_bytes = 0;     // to the end of the last whole chunk
  std::uint64_t dropped_bytes = 0;  // behind it: parts of a chunk, or of an unfinished summary
};

/// Gives a record that ends early (its writer was killed, the disk was full) the index and the footer that readers ask
/// for, in place: what stands to the last whole chunk keeps its bytes, and the rest becomes what the writer would have
/// written there. Throws UserError, and changes nothing, for what is no record, for one that a process still writes,
/// and for one that is damaged before its end; DataLost if there is no room for the index.
Repair repair(const std::filesystem::path& file);

}  // namespace ensonify::record
