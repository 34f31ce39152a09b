#pragma once

#include <chrono>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "launch/batch/job.h"
#include "launch/batch/results.h"

namespace ensonify::batch {

struct PoolSettings {
  std::size_t at_once = 1;
  std::chrono::milliseconds longest{3'600'000};  // of a run, wall time; one that takes longer is ended
  std::string program_folder;                    // of `ensonify-run`
  std::vector<std::string> run_words;            // that each `ensonify run` is also given: --free
};

/// Runs jobs by `ensonify run`, several at once, in their order, and keeps their results in the folder; those that are
/// done already are left out. `ended` is called as each ends, in whatever order that is, and says whether more are to
/// begin. Ctrl-C ends the runs that are under way in order, and none is begun after it. Returns false after Ctrl-C.
bool run_jobs(std::span<const Job> jobs, const Folder& folder, const PoolSettings& settings,
              const std::function<bool(const Job&)>& ended);

}  // namespace ensonify::batch
