#include "components/sonar/settings.h"

#include <catch2/catch.hpp>
#include <limits>

using namespace ensonify;
using Remarks = std::vector<std::string>;

namespace {

HeadSettings start() {
  HeadSettings settings;
  settings.range_m = 100.0;
  settings.source_level_db = 215.0;
  settings.pulse_length_s = 100e-6;
  settings.swath_rad = 2.0;
  settings.ping_rate_hz = 10.0;
  settings.mode = "equiangle";
  return settings;
}

SettingLimits limits() {
  SettingLimits limits;
  limits["range_m"] = {{1.0, 200.0}, true};
  limits["source_level_db"] = {{190.0, 220.0}};
  limits["pulse_length_s"] = {{25e-6, 1e-3}};
  limits["swath_rad"] = {{0.2, 2.4}};
  limits["ping_rate_hz"] = {{0.1, 50.0}};
  limits["mode"].words = {"equiangle", "equidistant"};
  return limits;
}

}  // namespace

TEST_CASE("a command counts from the next ping on, and only for what it names") {
  CommandedSettings settings(start(), limits());
  msg::SonarSettings stronger;
  stronger.source_level_db = 218.0;
  CHECK(settings.command(stronger).empty());
  HeadSettings expected = start();
  expected.source_level_db = 218.0;
  CHECK(settings.at_ping() == expected);
  CHECK(settings.command(msg::SonarSettings{}).empty());
  CHECK(settings.at_ping() == expected);
}

TEST_CASE("two commands before a ping add up; of two for the same setting the later counts") {
  CommandedSettings settings(start(), limits());
  msg::SonarSettings first, second;
  first.swath_rad = 1.0;
  first.mode = "equidistant";
  second.swath_rad = 1.5;
  settings.command(first);
  settings.command(second);
  CHECK(settings.at_ping().swath_rad == 1.5);
  CHECK(settings.at_ping().mode == "equidistant");
}

TEST_CASE("beyond limits is clamped, missing settings are refused, each with a remark") {
  CommandedSettings settings(start(), limits());
  msg::SonarSettings command;
  command.range_m = 900.0;
  command.ping_rate_hz = -std::numeric_limits<double>::infinity();
  command.gain_offset_db = 12.0;
  command.mode = "high_density";
  command.pulse_length_s = 50e-6;
  CHECK(settings.command(command) == Remarks{"range_m=900 is outside [1, 200]: set to 200",
                                             "gain_offset_db=12 refused: this head has no such setting",
                                             "ping_rate_hz=-inf is outside [0.1, 50]: set to 0.1",
                                             "mode=high_density refused: not one of equiangle, equidistant"});
  HeadSettings expected = start();
  expected.range_m = 200.0;
  expected.ping_rate_hz = 0.1;
  expected.pulse_length_s = 50e-6;
  CHECK(settings.at_ping() == expected);
}

TEST_CASE("a range of 0 lets the head choose up to the longest, where it can") {
  CommandedSettings settings(start(), limits());
  msg::SonarSettings command;
  command.range_m = 0.0;
  CHECK(settings.command(command).empty());
  CHECK(settings.at_ping().auto_range);
  CHECK(settings.at_ping().range_m == 200.0);
  command.range_m = 60.0;
  settings.command(command);
  CHECK_FALSE(settings.at_ping().auto_range);
  CHECK(settings.at_ping().range_m == 60.0);

  SettingLimits by_hand = limits();
  by_hand["range_m"].chosen = false;
  CommandedSettings manual(start(), by_hand);
  command.range_m = 0.0;
  CHECK(manual.command(command) == Remarks{"range_m=0 refused: this head does not choose it"});
  CHECK(manual.at_ping() == start());
}

TEST_CASE("a pulse length of 0 lets the head choose again, where it can") {
  SettingLimits by_range = limits();
  by_range["pulse_length_s"].chosen = true;
  CommandedSettings settings(start(), by_range);
  msg::SonarSettings command;
  command.pulse_length_s = 0.0;
  CHECK(settings.command(command).empty());
  CHECK(settings.at_ping().pulse_length_s == 0.0);

  CommandedSettings manual(start(), limits());
  CHECK(manual.command(command) == Remarks{"pulse_length_s=0 refused: this head does not choose it"});
  CHECK(manual.at_ping() == start());
}

TEST_CASE("a pulse too short for the range is reported and kept, whichever was commanded") {
  SettingLimits by_range = limits();
  by_range.shortest_pulse_s = [](double range_m) { return 1e-6 * range_m; };
  CommandedSettings settings(start(), by_range);
  msg::SonarSettings pulse, farther, nearer;
  pulse.pulse_length_s = 50e-6;
  CHECK(settings.command(pulse) == Remarks{"pulse_length_s=5e-05 is too short for range_m=100: 0.0001 is sent"});
  farther.range_m = 200.0;
  CHECK(settings.command(farther) == Remarks{"pulse_length_s=5e-05 is too short for range_m=200: 0.0002 is sent"});
  nearer.range_m = 50.0;
  CHECK(settings.command(nearer).empty());
  CHECK(settings.at_ping().pulse_length_s == 50e-6);
  CHECK(settings.command(msg::SonarSettings{}).empty());
}

TEST_CASE("what is fixed says at what") {
  SettingLimits fixed = limits();
  fixed["swath_rad"] = {{2.0, 2.0}};
  CommandedSettings settings(start(), fixed);
  msg::SonarSettings command;
  command.swath_rad = 1.0;
  CHECK(settings.command(command) == Remarks{"swath_rad=1 refused: on this head it is fixed at 2"});
  CHECK(settings.at_ping() == start());
  command.swath_rad = 2.0;
  CHECK(settings.command(command).empty());
}

TEST_CASE("a ping states its settings") {
  msg::Ping ping;
  ping.applied.frequency_hz = 300e3;
  fill(ping.applied, start());
  CHECK(ping.applied.frequency_hz == 300e3);
  CHECK(ping.applied.source_level_db == 215.0);
  CHECK(ping.applied.mode == "equiangle");
}
