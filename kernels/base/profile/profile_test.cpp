#include "kernels/base/profile/profile.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

using namespace ensonify;
using profile::Span, profile::Stage;

namespace {

constexpr std::int64_t kMs = 1'000'000;

profile::Sum sum_of(const profile::Report& report, Stage stage) { return report.sums[static_cast<std::size_t>(stage)]; }

void sleep_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

}  // namespace

// One case: measuring begins once in a process.
TEST_CASE("spans are summed by stage over all threads, none before the start") {
  { const Span span(Stage::kTrace); }
  CHECK(sum_of(profile::report(), Stage::kTrace).count == 0);

  profile::start();
  for (int i = 0; i < 2; ++i) {
    const Span step(Stage::kStep);
    const Span trace(Stage::kTrace, 20);
    sleep_ms(5);
  }
  const auto share = [] {
    const Span part(Stage::kSpread);
    sleep_ms(5);
  };
  std::thread other(share);
  share();
  other.join();

  const profile::Report report = profile::report();
  CHECK(sum_of(report, Stage::kTrace).count == 2);
  CHECK(sum_of(report, Stage::kTrace).items == 40);
  CHECK(sum_of(report, Stage::kTrace).wall_ns >= 10 * kMs);
  CHECK(sum_of(report, Stage::kTrace).wall_ns <= sum_of(report, Stage::kStep).wall_ns);
  CHECK(sum_of(report, Stage::kTrace).processor_ns < sum_of(report, Stage::kTrace).wall_ns);  // it slept
  CHECK(sum_of(report, Stage::kSpread).count == 2);
  CHECK(sum_of(report, Stage::kSpread).wall_ns >= 10 * kMs);
  CHECK(sum_of(report, Stage::kSpread).processor_ns < sum_of(report, Stage::kSpread).wall_ns);
  CHECK(report.end_ns - report.begin_ns >= 15 * kMs);

  REQUIRE(report.events.size() == 4);  // parts have none
  CHECK(report.events[0].begin_ns <= report.events[1].begin_ns);
  CHECK(report.events[0].duration_ns >= 5 * kMs);
}
