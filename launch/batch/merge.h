#pragma once

#include <string>
#include <vector>

#include "launch/batch/job.h"

namespace ensonify::batch {

/// A batch that was run in parts (shard_of()), each in a folder of its own.
struct Shards {
  std::vector<Job> plan;             // of the whole
  std::vector<std::string> folders;  // that has each job, in the plan's order
};

/// Reads the folders of all parts. Throws UserError, with the names of folders and jobs, for one that is no batch's,
/// parts of other versions, processors, programs or plans, and jobs that no part has done or more than one has.
Shards read_shards(const std::vector<std::string>& folders);

/// Puts the runs of all parts into the folder `out`, with the plan and the table that one batch would have. The
/// parts stay as they are. Precondition: `out` is none of them.
void put_together(const Shards& shards, const std::string& out);

}  // namespace ensonify::batch
