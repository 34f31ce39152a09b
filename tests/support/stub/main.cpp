#include "launch/process/run.h"
#include "tests/support/stub/node.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::StubNode>(argc, argv); }
