#include "components/towed_body/node.h"
#include "launch/process/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::TowedBodyNode>(argc, argv); }
