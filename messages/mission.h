#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "messages/array.h"

namespace ensonify::msg {

struct Mark {
  static constexpr const char* kType = "mark/1";
  static constexpr const char* kAbout = "Something worth finding again, as a mission or an agent notes it.";
  std::int64_t stamp_ns = 0;
  std::string text;
  std::array<double, 3> position_enu_m{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of the mark, sim time", self.stamp_ns);
    visit("text", "", "description of the mark", self.text);
    visit("position_enu_m", "m", "estimated position of the vehicle then: east, north, up", self.position_enu_m);
  }
};

struct NextLine {
  static constexpr const char* kType = "next_line/1";
  static constexpr const char* kAbout = "The line that an adaptive survey is to run next.";
  std::int64_t stamp_ns = 0;
  std::int64_t number = 0;
  bool done = false;
  std::array<double, 2> start_enu_m{};
  std::array<double, 2> end_enu_m{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of the decision, sim time", self.stamp_ns);
    visit("number", "1", "index of the line in the survey, the first is 0 and known beforehand", self.number);
    visit("done", "", "true when nothing is left to run; the line means nothing then", self.done);
    visit("start_enu_m", "m", "start of the line: east, north", self.start_enu_m);
    visit("end_enu_m", "m", "end of the line: east, north", self.end_enu_m);
  }
};

struct Coverage {
  static constexpr const char* kType = "coverage/1";
  static constexpr const char* kAbout = "What soundings have covered so far, by estimate: cells of a rectangle.";
  std::int64_t stamp_ns = 0;
  std::int64_t lines = 0;
  std::array<double, 2> corner_enu_m{};
  double heading_grid_rad = 0.0;
  double cell_m = 1.0;
  std::int64_t needed = 1;
  double covered = 0.0;
  double overlapped = 0.0;
  double track_m = 0.0;
  double elapsed_s = 0.0;
  Array<std::uint16_t> soundings;
  Array<float> height_m;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of validity, sim time", self.stamp_ns);
    visit("lines", "1", "number of lines run", self.lines);
    visit("corner_enu_m", "m", "the rectangle's rear port corner: east, north", self.corner_enu_m);
    visit("heading_grid_rad", "rad", "forward along the rectangle, clockwise from grid north", self.heading_grid_rad);
    visit("cell_m", "m", "side of a cell", self.cell_m);
    visit("needed", "1", "accepted soundings that a covered cell has at least", self.needed);
    visit("covered", "1", "share of the cells that are covered", self.covered);
    visit("overlapped", "1", "redundancy: how often a covered cell was covered, by lines, on average", self.overlapped);
    visit("track_m", "m", "length of all lines run, without turns", self.track_m);
    visit("elapsed_s", "s", "time from the first sounding to the last", self.elapsed_s);
    visit("soundings", "1", "accepted soundings of each cell (starboard x forward), as far as it can count",
          self.soundings);
    visit("height_m", "m", "mean height of each cell's accepted soundings, up from chart datum; NaN: none",
          self.height_m);
  }
};

}  // namespace ensonify::msg
