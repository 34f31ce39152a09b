#include "components/nav_feed/node.h"
#include "components/runtime/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::NavFeedNode>(argc, argv); }
