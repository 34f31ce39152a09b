#pragma once

namespace ensonify {

/// Whether the program was started as a process of a run (it is given its launch and name) or typed by a user.
bool is_process_of_run(int argc, char** argv);

/// `ensonify replay FILE`: becomes `ensonify run launch/replay.yaml --arg record=FILE`. Returns only with an exit code.
int replay_verb(int argc, char** argv);

}  // namespace ensonify
