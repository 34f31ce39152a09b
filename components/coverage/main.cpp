#include "components/coverage/node.h"
#include "components/runtime/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::CoverageNode>(argc, argv); }
