#include "components/expect/node.h"
#include "components/runtime/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::ExpectNode>(argc, argv); }
