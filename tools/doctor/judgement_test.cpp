#include "tools/doctor/judgement.h"

#include <catch2/catch.hpp>

namespace ensonify::doctor {

TEST_CASE("a CPU without AVX2 fails, and a name that only begins so does not count") {
  CHECK(judge_cpu("fpu sse2 avx avx2 fma").level == Level::kOk);
  CHECK(judge_cpu("fpu sse2 avx fma avx2x").level == Level::kFail);
  CHECK(judge_cpu("fpu sse2 avx2").text == "has no fma");
  CHECK(judge_cpu("").level == Level::kWarn);
}

TEST_CASE("memory and disks are judged by what a survey needs") {
  CHECK(judge_memory(8'000'000'000).level == Level::kOk);
  CHECK(judge_memory(1'500'000'000).level == Level::kWarn);
  CHECK(judge_memory(1'500'000'000).text == "1.5 GB available");
  CHECK(judge_memory(100'000'000).level == Level::kFail);
  CHECK(judge_disk("disk", {".", 20'000'000'000, true}, 600'000'000).level == Level::kOk);
  CHECK(judge_disk("disk", {".", 2'000'000'000, true}, 600'000'000).level == Level::kWarn);
  CHECK(judge_disk("disk", {".", 500'000'000, true}, 600'000'000).level == Level::kFail);
  CHECK(judge_disk("disk", {".", 20'000'000'000, false}, 1).text == ". cannot be written");
  CHECK(judge_disk("disk", {"/nowhere", {}, false}, 1).text == "/nowhere cannot be read");
}

TEST_CASE("one core, few descriptors and slow clocks are warned of") {
  CHECK(judge_cores(1).level == Level::kWarn);
  CHECK(judge_cores(2).level == Level::kOk);
  CHECK(judge_open_files(1024).level == Level::kOk);
  CHECK(judge_open_files(256).level == Level::kWarn);
  CHECK(judge_open_files(64).level == Level::kFail);
  CHECK(judge_clock("tsc", 25.0).level == Level::kOk);
  CHECK(judge_clock("hpet", 25.0).level == Level::kWarn);
  CHECK(judge_clock("tsc", 2000.0).level == Level::kWarn);
}

TEST_CASE("a socket path is judged by the longest name that a run may need") {
  CHECK(judge_socket_path("/run/user/1000/ensonify").level == Level::kOk);
  CHECK(judge_socket_path(std::string(47, 'x')).level == Level::kOk);
  CHECK(judge_socket_path(std::string(48, 'x')).level == Level::kWarn);
}

TEST_CASE("the run folder must be ours, and private") {
  const auto judged = [](bool exists, bool ours, bool is_private, bool can_be_made) {
    return judge_runs_folder({"/tmp/ensonify-7", exists, ours, is_private, can_be_made}).level;
  };
  CHECK(judged(true, true, true, true) == Level::kOk);
  CHECK(judged(true, true, false, true) == Level::kWarn);
  CHECK(judged(true, false, true, true) == Level::kFail);
  CHECK(judged(false, false, false, true) == Level::kOk);
  CHECK(judged(false, false, false, false) == Level::kFail);
}

TEST_CASE("whatever is not well comes with advice") {
  for (const Finding& finding : {judge_cpu(""), judge_cpu("x"), judge_cores(1), judge_memory(1), judge_open_files(9),
                                 judge_disk("disk", {"x", {}, false}, 1), judge_disk("disk", {"x", 0, true}, 1),
                                 judge_clock("hpet", 1.0), judge_runs_folder({.path = "x"})}) {
    CHECK_FALSE(finding.advice.empty());
    CHECK(finding.level != Level::kOk);
  }
  CHECK(judge_cores(4).advice.empty());
}

}  // namespace ensonify::doctor
