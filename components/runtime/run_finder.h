#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ensonify {

/// What the launcher writes of a run into its directory, for whoever lists runs. Fields that are not known are empty or
/// 0.
struct AboutRun {
  std::string name;    // given with `ensonify run --name`
  std::string launch;  // its file, an absolute path
  std::string out;     // folder of its results, an absolute path
  std::int64_t began_unix_s = 0;
  std::int64_t process = 0;  // of the launcher

  /// "launch/demo.yaml, 3 min old, process 1234"; paths below the current folder are shortened.
  std::string text() const;
};

/// Writes about.json of a run directory. Throws UserError when the file cannot be written.
void write_about(const std::string& folder, const AboutRun& about);
/// All fields empty where the file is not there or cannot be understood.
AboutRun read_about(const std::string& folder);

/// Why a name cannot be given to a run; "" when it can. Ids of run directories cannot.
std::string fault_of_run_name(const std::string& name);

/// A run directory with somebody at its clock's endpoint.
struct LiveRun {
  std::string folder;
  std::string endpoint;  // "ipc://..." or "tcp://127.0.0.1:..."
  AboutRun about;

  /// What `--run` takes: the run's name, else the name of its folder.
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

/// A live run by its name, its directory, the id of that or its clock's endpoint (the folder is then ""); "" means
/// $ENSONIFY_RUN, else the only live run. Throws UserError when there is none, several, or a dead one, and says what to
/// do.
LiveRun find_run(const std::string& run, const std::string& folder = runs_folder());

}  // namespace ensonify
