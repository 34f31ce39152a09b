#include "components/nav_feed/node.h"
#include "launch/process/run.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::NavFeedNode>(argc, argv); }
