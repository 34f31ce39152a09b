#include "components/runtime/run.h"
#include "components/scanning/node.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::ScanningNode>(argc, argv); }
