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

/// Folders that may hold run directories of this user, best first: `$XDG_RUNTIME_DIR/ensonify`, `/tmp/ensonify-<uid>`.
/// Folders of other users are left out.
std::vector<std::string> runs_folders();

/// Runs of these folders whose clock listens, sorted by folder. Listening means that its socket takes connections.
std::vector<LiveRun> live_runs(const std::vector<std::string>& folders);
/// Run directories whose clock is gone and whose lock nobody holds: left behind, cleared by the next `ensonify run`.
std::vector<std::string> dead_runs(const std::vector<std::string>& folders);

/// The endpoint of a run's clock. `run` is a run directory, the id of one or an endpoint; "" means $ENSONIFY_RUN, else
/// the only live run of the first folder that has any. Throws UserError when there is none, several, or a dead one, and
/// says what to do.
std::string find_clock(const std::string& run, const std::vector<std::string>& folders = runs_folders());

}  // namespace ensonify
