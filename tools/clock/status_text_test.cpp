#include "tools/clock/status_text.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace ensonify::clock_tool {

using nlohmann::json;

TEST_CASE("the status of a paused run names who waits for whom") {
  const json status = json::parse(R"({"kind":"status","state":"paused","sim_ns":1500000000,"end_ns":null,"wall_s":2.04,
    "rate":4.0,"slips":2,"slip_s":0.75,"exit_code":0,"culprit":"","message":"","participants":[
    {"name":"auv","pid":7,"grants":20,"cost_s":0.5,"late_events":1,"worst_lateness_s":0.2,"next_ns":1500000000,
     "running":true,"waiting_on":[]},
    {"name":"bow","pid":8,"grants":4,"cost_s":0.25,"late_events":0,"worst_lateness_s":0,"next_ns":null,
     "running":false,"waiting_on":["auv","pager"]}]})");
  CHECK(status_text(status) ==
        "paused, paced at 4x, t=1.500 s, 2.0 s wall, slipped 2 times by 0.750 s in all\n"
        "participant    next (s)  cost (s)      grants    late  now\n"
        "auv               1.500     0.500          20       1  running\n"
        "bow               never     0.250           4       0  waits for auv, pager\n");
}

TEST_CASE("before time starts the status names who is missing") {
  const json status =
      json::parse(R"({"kind":"status","state":"connecting","epoch":3,"sim_ns":0,"end_ns":60000000000,"wall_s":0,
    "rate":"free","slips":0,"slip_s":0,"exit_code":0,"culprit":"","message":"","participants":[],
    "missing":["auv","bow"]})");
  CHECK(status_text(status) ==
        "connecting, free running, t=0.000 s of 60.000 s, epoch 3, 0.0 s wall\nwaiting for the hello of auv, bow\n");
}

}  // namespace ensonify::clock_tool
