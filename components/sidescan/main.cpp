#include "components/runtime/run.h"
#include "components/sidescan/node.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::SidescanNode>(argc, argv); }
