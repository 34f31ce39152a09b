#include "components/replay/node.h"
#include "components/replay/verb.h"
#include "launch/process/run.h"

int main(int argc, char** argv) {
  if (!ensonify::is_process_of_run(argc, argv)) return ensonify::replay_verb(argc, argv);
  return ensonify::run<ensonify::ReplayNode>(argc, argv);
}
