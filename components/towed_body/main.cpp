#include "components/runtime/run.h"
#include "components/towed_body/node.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::TowedBodyNode>(argc, argv); }
