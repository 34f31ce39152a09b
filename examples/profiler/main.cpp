#include "examples/profiler/node.h"
#include "launch/process/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::ProfilerNode>(argc, argv); }
