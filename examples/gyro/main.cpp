#include "components/runtime/run.h"
#include "examples/gyro/node.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::GyroNode>(argc, argv); }
