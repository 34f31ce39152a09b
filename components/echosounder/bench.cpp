// Time of one ping of the default echosounder over a seabed 20 m deep.
#include "components/echosounder/head.h"
#include "components/sonar/testing/bench_ping.h"

using namespace ensonify;

namespace {

void one_ping(benchmark::State& state) {
  EchosounderConfig config;
  in_a_breeze(config);
  time_pings<Echosounder>(state, config, 18.0, 21.0);
}
BENCHMARK(one_ping)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
