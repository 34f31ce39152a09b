#include "examples/gyro/node.h"
#include "launch/process/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::GyroNode>(argc, argv); }
