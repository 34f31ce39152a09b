#include "components/runtime/run.h"
#include "components/terrain_pager/node.h"

int main(int argc, char** argv) { return ensonify::run<ensonify::TerrainPagerNode>(argc, argv); }
