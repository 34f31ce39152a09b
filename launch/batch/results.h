#pragma once

#include <optional>
#include <string>
#include <vector>

#include "launch/batch/job.h"
#include "launch/report.h"

namespace ensonify::batch {

/// What is kept of a job that has ended.
struct Result {
  std::string id, label;
  int exit_code = 0;  // of the run; kTimedOut: it was ended
  double sim_s = 0.0;
  std::string culprit, message;  // of a run that failed
  std::vector<launcher::Expectation> expectations;
  double wall_s = 0.0;  // not in the table

  static constexpr int kTimedOut = -1;
  bool passed() const { return exit_code == 0; }
  std::size_t failed() const;  // expectations
};

/// A batch's folder: `plan.json` (the jobs in order), `runs/ID/` (a run each; `result.json` comes last, whole or not at
/// all: it says that the job is done) and `results.csv` (a row for each job that is done, in the plan's order).
class Folder {
 public:
  /// Makes it, or goes on with one that holds the same plan. Throws UserError where it holds another.
  Folder(const std::string& path, const std::vector<Job>& plan);

  /// Its `plan.json`, with which merge() starts.
  static constexpr const char* kPlan = "/plan.json";
  /// Removes what an earlier batch has left in a folder, if one has.
  static void forget(const std::string& path);

  std::string run_of(const Job& job) const { return path_ + "/runs/" + job.id; }
  /// Nothing while it is not done.
  std::optional<Result> result_of(const Job& job) const;
  /// What `ensonify run --json` said, or nothing where it said nothing. Written to disk before this returns.
  void done(const Job& job, int exit_code, const std::string& run_json, double wall_s) const;
  /// Its run counts as not done.
  void undo(const Job& job) const;
  void write_table(const std::vector<Job>& plan) const;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The jobs of part i of n, from 1: every n-th.
std::vector<Job> shard_of(const std::vector<Job>& plan, std::size_t part, std::size_t parts);

}  // namespace ensonify::batch
