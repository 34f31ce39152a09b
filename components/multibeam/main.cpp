#include "components/multibeam/node.h"
#include "components/runtime/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::MultibeamNode>(argc, argv); }
