#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/config/parameters.h"
#include "components/nav_feed/feed_source.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

struct NavFeedParameters {
  enum class Height {
    kWater,  // the water level of the scenario, less what the hull settles by, plus the feed's heave
    kGga,    // GGA's heights, between fixes by the feed's heave
  };

  std::string vehicle;
  std::vector<FeedSource> sources{FeedSource{}};
  bool recorded = false;
  int pose_rate_hz = 100;
  double delay_s = 2.5;
  double fastest_mps = 30.0;
  double time_jump_s = 5.0;
  double straight_on_s = 10.0;
  double attitude_gap_s = 3.0;
  Height height = Height::kWater;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("vehicle", "", any(), "vehicle of the scenario; \"\": the one with the process's name, or the only one",
          self.vehicle);
    visit("sources", "the sources, by names of your own", self.sources);
    visit("recorded", "", any(),
          "record in place of the sources: the input `data` brings what another run took of them", self.recorded);
    visit("pose_rate_hz", "Hz", in(1, 1000), "true poses published per second", self.pose_rate_hz);
    visit("delay_s", "s", in(0, 60),
          "delay of the vehicle behind the feed; with less than two intervals between fixes its velocity jumps as they "
          "come",
          self.delay_s);
    visit("fastest_mps", "m/s", in(0.1, 1000), "a fix that asks for more counts only when others agree with it",
          self.fastest_mps);
    visit("time_jump_s", "s", in(0.1, 600),
          "a fix whose time is farther from its arrival than this counts only when others agree with it",
          self.time_jump_s);
    visit("straight_on_s", "s", in(1, 3600),
          "time for which the vehicle goes straight on without fixes, before it stays; fixes farther apart are not "
          "joined",
          self.straight_on_s);
    visit("attitude_gap_s", "s", in(0.05, 60),
          "samples of roll, pitch, heading and heave that are farther apart are not joined: the older one is held",
          self.attitude_gap_s);
    visit("height", "", one_of({{"water", Height::kWater}, {"gga", Height::kGga}}),
          "height of the vehicle: on the scenario's water level, or as the fixes' heights have it", self.height);
  }
  void check(const ConfigReader& from) const;
};

struct NavFeedConfig : NavFeedParameters {
  // From the scenario.
  std::optional<frames::Geodetic> origin;  // not given: the chart gives it
  vertical::Tide tide;
  motion::Current current;
  vertical::Datums datums;
  std::optional<vertical::Loading> floats;

  static NavFeedConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
