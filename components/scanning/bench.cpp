// Time of one ping that scans the seabed: 40 m, tilted down by 25 degrees, as bench.json has it.
#include "components/scanning/head.h"
#include "components/sonar/testing/bench_ping.h"

using namespace ensonify;

namespace {

void one_ping(benchmark::State& state) {
  ScanningConfig config;
  in_a_breeze(config);
  config.range_m = 40.0;
  config.tilt_rad = 25.0 * Scan::kDegree;
  time_pings<Scanning>(state, config, 18.0, 40.0);
}
BENCHMARK(one_ping)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
