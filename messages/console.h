#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "messages/array.h"

/// What a viewer in a browser and the console's gateway say to each other (docs/manual/console-wire.md). None of it
/// travels on a run's own planes.
namespace ensonify::msg {

/// A topic that can be watched.
struct ConsoleTopic {
  std::string name;
  std::string type;
  std::string publisher;
  std::string component;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", "", "name of the topic; of a head's pictures HEAD/view", self.name);
    visit("type", "", "message type", self.type);
    visit("publisher", "", "process that publishes it", self.publisher);
    visit("component", "", "component of the publisher, of a record for heads alone; empty: not known", self.component);
  }
};

/// Something that can be opened: a live run or a record.
struct ConsoleItem {
  std::string id;
  std::string kind;
  std::string text;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("id", "", "name by which it is opened", self.id);
    visit("kind", "", "run or record", self.kind);
    visit("text", "", "line that describes it", self.text);
  }
};

/// A number of a message type that can be drawn over time.
struct ConsoleScalar {
  std::string field;
  std::string unit;
  std::string about;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("field", "", "name of the number in its message, with dots where it lies deeper", self.field);
    visit("unit", "", "unit in which it is sent: degrees for angles", self.unit);
    visit("about", "", "meaning of the number", self.about);
  }
};

struct ConsoleType {
  std::string type;
  std::vector<ConsoleScalar> scalars;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("type", "", "message type", self.type);
    visit("scalars", "", "numbers of its messages, and what follows from them", self.scalars);
  }
};

struct ConsoleState {
  static constexpr const char* kType = "console_state/1";
  static constexpr const char* kAbout = "What a console shows, to its viewers when they enter and when it changes.";
  std::string kind;
  std::string name;
  std::string launch;
  std::string state;
  std::string message;
  bool may_control = false;
  std::int64_t exit_code = 0;
  double speed = 0.0;
  std::vector<ConsoleTopic> topics;
  std::vector<ConsoleType> types;
  std::vector<ConsoleItem> items;
  std::vector<std::string> launches;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("kind", "", "kind of source: run, record, or empty where nothing is open", self.kind);
    visit("name", "", "name of the run or record", self.name);
    visit("launch", "", "launch file of a run, as far as it is known", self.launch);
    visit("state", "", "waiting, running, paused or ended", self.state);
    visit("message", "", "why, in one line", self.message);
    visit("may_control", "", "true where this viewer may pause, resume, set the rate and stop", self.may_control);
    visit("exit_code", "1", "exit code of a run that has ended and was started by this console", self.exit_code);
    visit("speed", "1", "sim seconds per wall second that are asked for; 0: as fast as possible", self.speed);
    visit("topics", "", "topics that can be watched", self.topics);
    visit("types", "", "types of these topics that have numbers to be drawn over time", self.types);
    visit("items", "", "live runs and records that can be opened", self.items);
    visit("launches", "", "launch files of the installation, to be started from a shell", self.launches);
  }
};

/// How one watched topic reaches a viewer.
struct ConsoleFlowTopic {
  std::string topic;
  std::int64_t sent = 0;
  std::int64_t lost = 0;
  std::int64_t halved = 0;
  double rate_hz = 0.0;
  double age_s = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("topic", "", "name of the topic", self.topic);
    visit("sent", "1", "number of messages sent to this viewer", self.sent);
    visit("lost", "1", "number of messages that it was not sent: of pictures those that a newer one replaced",
          self.lost);
    visit("halved", "1", "number of times that its pictures are halved in width for the sake of the link", self.halved);
    visit("rate_hz", "Hz", "messages sent per second of wall time since the report before", self.rate_hz);
    visit("age_s", "s", "wall time from the arrival of the newest message at the gateway until the viewer had drawn it",
          self.age_s);
  }
};

struct ConsoleFlow {
  static constexpr const char* kType = "console_flow/1";
  static constexpr const char* kAbout = "How messages reach a viewer, once a second of wall time.";
  double link_bytes_per_s = 0.0;
  std::int64_t waiting_bytes = 0;
  std::vector<ConsoleFlowTopic> topics;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("link_bytes_per_s", "B/s", "rate of the link as the last pictures found it; 0: not known",
          self.link_bytes_per_s);
    visit("waiting_bytes", "1", "number of bytes that wait for this viewer", self.waiting_bytes);
    visit("topics", "", "topics that are watched", self.topics);
  }
};

struct ConsoleCells {
  static constexpr const char* kType = "console_cells/1";
  static constexpr const char* kAbout =
      "Cells of the grid that a console makes of all soundings: those that have changed, with all that fell into them.";
  std::int64_t generation = 0;
  std::int64_t since_ns = 0;
  double cell_m = 0.0;
  Array<std::int32_t> column;
  Array<std::int32_t> row;
  Array<std::uint32_t> count;
  Array<float> mean_depth_m;
  Array<float> shoalest_depth_m;
  Array<float> sd_m;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("generation", "1", "number of the grid; with another one all earlier cells are void", self.generation);
    visit("since_ns", "ns", "sim time of the first ping in the grid", self.since_ns);
    visit("cell_m", "m", "side of a cell", self.cell_m);
    visit("column", "1", "column of each cell: its western edge lies at column times cell_m", self.column);
    visit("row", "1", "row of each cell: its southern edge lies at row times cell_m", self.row);
    visit("count", "1", "number of soundings in each cell", self.count);
    visit("mean_depth_m", "m", "mean depth of each cell, positive down from chart datum", self.mean_depth_m);
    visit("shoalest_depth_m", "m", "least depth of each cell", self.shoalest_depth_m);
    visit("sd_m", "m", "standard deviation of each cell's depths; NaN of fewer than two", self.sd_m);
  }
};

struct ConsoleTrack {
  static constexpr const char* kType = "console_track/1";
  static constexpr const char* kAbout = "Track of a vehicle as it grows: new points, and where the vehicle is now.";
  std::int64_t generation = 0;
  std::string source;
  bool truth = false;
  std::int64_t stamp_ns = 0;
  std::array<double, 3> position_enu_m{};
  double heading_rad = 0.0;
  std::int64_t first = 0;
  Array<double> point_enu_m;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("generation", "1", "number of the track; with another one all earlier points are void", self.generation);
    visit("source", "", "name of the topic that the track comes from", self.source);
    visit("truth", "", "true for the true pose, false for an estimate", self.truth);
    visit("stamp_ns", "ns", "sim time of the newest position", self.stamp_ns);
    visit("position_enu_m", "m", "newest position: east, north, up from chart datum", self.position_enu_m);
    visit("heading_rad", "rad", "newest heading, clockwise from grid north", self.heading_rad);
    visit("first", "1", "index of the first of the new points", self.first);
    visit("point_enu_m", "m", "new points (point x 2): east, north; half a metre apart or more", self.point_enu_m);
  }
};

/// New points of one number.
struct ConsoleSeries {
  std::string name;
  std::string unit;
  std::int64_t first = 0;
  Array<double> time_s;
  Array<double> value;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", "", "name of the number: TOPIC.field", self.name);
    visit("unit", "", "unit of its values; empty: not known", self.unit);
    visit("first", "1", "index of the first of the new points", self.first);
    visit("time_s", "s", "sim time of each point", self.time_s);
    visit("value", "",
          "value of each point; NaN: a gap. Of more than ten a second, the least and the greatest of every 0.2 s",
          self.value);
  }
};

struct ConsoleValues {
  static constexpr const char* kType = "console_values/1";
  static constexpr const char* kAbout = "Numbers over time: new points of those that a viewer asks for.";
  std::int64_t generation = 0;
  std::vector<ConsoleSeries> series;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("generation", "1", "number of the run; with another one all earlier points are void", self.generation);
    visit("series", "", "numbers with new points", self.series);
  }
};

/// Something that an operator has to know of.
struct ConsoleAlarm {
  std::string kind;
  std::string source;
  std::string text;
  bool active = false;
  std::int64_t raised = 0;
  std::int64_t since_ns = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("kind", "", "no_bottom, off_line, late, late_pings, slips, lost, disk, degraded or failed", self.kind);
    visit("source", "", "name of the process, topic or folder that it is about", self.source);
    visit("text", "", "cause, in one line", self.text);
    visit("active", "", "true while its cause lasts; what happens at a moment is never active", self.active);
    visit("raised", "1", "number of times that it was raised; one that is higher needs another acknowledgement",
          self.raised);
    visit("since_ns", "ns", "sim time at which it was raised last", self.since_ns);
  }
};

struct ConsoleAlarms {
  static constexpr const char* kType = "console_alarms/1";
  static constexpr const char* kAbout = "All alarms of a run, those that have passed as well.";
  std::int64_t generation = 0;
  std::vector<ConsoleAlarm> alarms;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("generation", "1", "number of the run; acknowledgements of another one are void", self.generation);
    visit("alarms", "", "alarms, at most 64", self.alarms);
  }
};

struct ConsoleLogLine {
  std::string process;
  std::string level;
  std::string text;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("process", "", "name of the process that wrote it", self.process);
    visit("level", "", "error, warning or info, by the words of the line", self.level);
    visit("text", "", "line, at most 500 bytes", self.text);
  }
};

struct ConsoleLog {
  static constexpr const char* kType = "console_log/1";
  static constexpr const char* kAbout = "New lines of the logs that a run's processes write, the newest last.";
  std::int64_t generation = 0;
  std::int64_t first = 0;
  std::vector<ConsoleLogLine> lines;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("generation", "1", "number of the run; with another one all earlier lines are void", self.generation);
    visit("first", "1", "index of the first of these lines, of all that were read", self.first);
    visit("lines", "", "lines", self.lines);
  }
};

struct ConsoleRelief {
  static constexpr const char* kType = "console_relief/1";
  static constexpr const char* kAbout =
      "The seabed of chart/1 as shaded relief with contours, and where the world lies.";
  std::string projection;
  double west_m = 0.0;
  double south_m = 0.0;
  double spacing_m = 1.0;
  Array<std::uint8_t> shade;
  double exaggeration = 1.0;
  double contour_step_m = 0.0;
  Array<float> contour_depth_m;
  Array<float> contour_m;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("projection", "", "map of the world's plane, in the words of PROJ: east and north in metres on WGS 84",
          self.projection);
    visit("west_m", "m", "world east of the western posts", self.west_m);
    visit("south_m", "m", "world north of the southern posts", self.south_m);
    visit("spacing_m", "m", "distance between posts", self.spacing_m);
    visit(
        "shade", "1",
        "brightness of each post (north x east, south-west first) in light from the north-west, 1 dark to 255 bright; "
        "0: nothing is known",
        self.shade);
    visit("exaggeration", "1", "factor by which slopes are steeper in the shading than they are", self.exaggeration);
    visit("contour_step_m", "m", "difference of depth between contours", self.contour_step_m);
    visit("contour_depth_m", "m", "depth of each piece of a contour, below chart datum", self.contour_depth_m);
    visit("contour_m", "m", "straight pieces of contours (piece x 4): east and north of both ends", self.contour_m);
  }
};

/// A mark on the chart.
struct ConsoleMark {
  std::string text;
  std::array<double, 2> position_enu_m{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("text", "", "description of the mark", self.text);
    visit("position_enu_m", "m", "estimated position of the vehicle then: east, north", self.position_enu_m);
  }
};

struct ConsolePlan {
  static constexpr const char* kType = "console_plan/1";
  static constexpr const char* kAbout = "What is planned, and what was marked: for a viewer's chart.";
  Array<double> line_enu_m;
  std::vector<ConsoleMark> marks;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("line_enu_m", "m", "runlines in the order run (line x 4): east and north of the start, then of the end",
          self.line_enu_m);
    visit("marks", "", "marks, the oldest first", self.marks);
  }
};

struct ConsoleEnter {
  static constexpr const char* kType = "console_enter/1";
  static constexpr const char* kAbout = "A viewer's first message, within 2 s.";
  std::string token;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("token", "", "token of the URL to view or to control", self.token);
  }
};

/// A topic that a viewer watches.
struct ConsoleWatched {
  std::string topic;
  std::int64_t cells = 1024;
  bool peak = false;
  double spreading_db = 0.0;
  double absorption_dbpm = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("topic", "", "name of the topic", self.topic);
    visit("cells", "1", "most cells of a picture over range, 16 to 1024", self.cells);
    visit("peak", "", "choice of a cell's level: true its strongest sample", self.peak);
    visit("spreading_db", "dB", "S of the gain S log10(R) + 2 A R to add for display, 0 to 60", self.spreading_db);
    visit("absorption_dbpm", "dB/m", "absorption A of the gain to add, 0 to 1", self.absorption_dbpm);
  }
};

struct ConsoleWatch {
  static constexpr const char* kType = "console_watch/1";
  static constexpr const char* kAbout = "A viewer says all that it watches from now on.";
  bool hidden = false;
  std::vector<ConsoleWatched> topics;
  std::vector<std::string> values;
  std::vector<std::string> ground;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("hidden", "", "true while nobody can see the page: nothing is sent to it", self.hidden);
    visit("topics", "", "topics, at most 64", self.topics);
    visit("values", "", "names of numbers (TOPIC.field) of the topic values, at most 32", self.values);
    visit("ground", "", "topics of these whose ranges are to lie on the ground, where the head's altitude is known",
          self.ground);
  }
};

struct ConsoleDrawn {
  static constexpr const char* kType = "console_drawn/1";
  static constexpr const char* kAbout = "A viewer has drawn a picture or a line and can take the next.";
  std::string topic;
  std::int64_t seq = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("topic", "", "name of the topic", self.topic);
    visit("seq", "1", "seq of the message's envelope", self.seq);
  }
};

struct ConsoleOpen {
  static constexpr const char* kType = "console_open/1";
  static constexpr const char* kAbout = "A viewer asks for another run or record.";
  std::string id;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("id", "", "id of an item of console_state/1", self.id);
  }
};

struct ConsoleCommand {
  static constexpr const char* kType = "console_command/1";
  static constexpr const char* kAbout = "A command to the run, from a viewer that came by the URL to control.";
  std::string command;
  double rate = 1.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("command", "", "pause, resume, rate or stop", self.command);
    visit("rate", "1", "sim seconds per wall second for the command rate; 0: as fast as possible", self.rate);
  }
};

struct ConsoleAnswer {
  static constexpr const char* kType = "console_answer/1";
  static constexpr const char* kAbout = "Why something that a viewer asked for was not done.";
  std::string request;
  std::string error;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("request", "", "type of the message that asked", self.request);
    visit("error", "", "cause and what is allowed", self.error);
  }
};

}  // namespace ensonify::msg
