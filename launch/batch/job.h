#pragma once

#include <string>
#include <vector>

#include "launch/file/launch_file.h"

/// Many launches: what runs them, and what is left of it on disk. Whoever needs launches by the hundred makes a list of
/// jobs and reads the table.
namespace ensonify::batch {

/// A launch among many.
struct Job {
  std::string label;      // what a table calls it
  LaunchOptions options;  // `out` is the batch's to choose
  std::string id;         // id_of()
  std::string programs;   // sum of those that it runs, where shards are to be compared
};

/// What decides a launch's results, as 16 hexadecimal digits: the launch and its scenario as they are resolved, the
/// bytes of every file that they name, the programs that it runs, this version and the processor's vector units
/// (between which levels differ by 0.01 dB). Pacing, the output folder and the place of the files change nothing.
std::string id_of(const Launch& launch, const std::string& program_folder);
/// The part of it that is of the programs' bytes.
std::string programs_of(const Launch& launch, const std::string& program_folder);
/// The part of it that is of the processor: avx2 or avx512.
std::string vector_units();
/// An id of any words, in their order.
std::string id_of(const std::vector<std::string>& words);

}  // namespace ensonify::batch
