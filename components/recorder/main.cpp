#include "components/recorder/node.h"
#include "launch/process/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::RecorderNode>(argc, argv); }
