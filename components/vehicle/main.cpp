#include "components/runtime/run.h"
#include "components/vehicle/node.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::VehicleNode>(argc, argv); }
