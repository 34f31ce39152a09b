#include "components/recorder/node.h"
#include "components/runtime/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::RecorderNode>(argc, argv); }
