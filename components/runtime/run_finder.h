#pragma once

#include <string>
#include <vector>

namespace ensonify {

/// A run directory with somebody at its clock's endpoint.
struct LiveRun {
  std::string folder;
  std::string endpoint;  // "ipc://..." or "tcp://127.0.0.1:..."

  /// Name of the folder: what `--run` takes.
  std::string id() const;
};

/// Longest name of a folder that can hold run directories: a socket path has at most 107 bytes, and "/run-XXXXXX/" and
/// the longest process name with its ending follow.
inline constexpr std::size_t kLongestRunsFolder = 107 - 60;

/// The folder of this user's run directories, as the launcher chooses it: `$XDG_RUNTIME_DIR/ensonify`, or
/// `/tmp/ensonify-<uid>` when that variable is unset, or names a folder that is too long or not ours to use.
std::string runs_folder();

/// Runs of this folder whose clock listens, sorted by name. Listening means that its socket takes connections.
std::vector<LiveRun> live_runs(const std::string& folder);
/// Run directories whose clock is gone and whose lock nobody holds: left behind, cleared by the next `ensonify run`.
std::vector<std::string> dead_runs(const std::string& folder);

/// A live run by its directory, the id of that or its clock's endpoint (the folder is then ""); "" means $ENSONIFY_RUN,
/// else the only live run. Throws UserError when there is none, several, or a dead one, and says what to do.
LiveRun find_run(const std::string& run, const std::string& folder = runs_folder());

}  // namespace ensonify
