#include "components/forward_looking/node.h"
#include "launch/process/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::ForwardLookingNode>(argc, argv); }
