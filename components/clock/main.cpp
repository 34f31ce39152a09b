#include "components/clock/program.h"

int main(int argc, char** argv) { return ensonify::clock::clock_main(argc, argv); }
