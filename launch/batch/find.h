#pragma once

#include <string>
#include <vector>

#include "launch/batch/job.h"

namespace ensonify::batch {

/// A launch file that was asked for, directly or by its folder.
struct Found {
  std::string file;
  Job job;                        // where it can be run
  std::vector<std::string> args;  // names of the arguments that it has
  std::string skipped;            // why it is not: an argument is missing, or it waits for somebody; "": it is run
  std::string fault;              // why it cannot be read; "": it can
};

/// What launch files are read with.
struct FindOptions {
  std::vector<std::string> args, sets;  // as of `ensonify run`; an argument goes to the files that have it
  std::string text;                     // only files whose path holds it; "": all
};

/// The launch files with expectations among these files and in these folders, in the order of paths and, in a folder,
/// of names; each once. Files that stand in a folder without expectations, or that are no launch files, are passed
/// over. Throws UserError for a path that does not exist, a file named directly that holds no expectation, an argument
/// that no file has, and where nothing is found.
std::vector<Found> find_launches(const std::vector<std::string>& paths, const FindOptions& options,
                                 const std::string& program_folder);

}  // namespace ensonify::batch
