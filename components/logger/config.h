#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/parameters.h"
#include "components/logger/vessel.h"
#include "components/logger/xtf/samples.h"
#include "kernels/base/frames/local_projection.h"
#include "kernels/water/refraction/profile.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

/// Formats in the order given.
struct FormatList : std::vector<std::string> {
  using std::vector<std::string>::vector;
  ConfigNode in_file() const;
  bool has(const std::string& format) const;
};

/// Those that a logger writes.
struct LoggedFormats : FormatList {
  using FormatList::FormatList;
  void read(ConfigReader& from, const char* key);
  static std::string schema();
};

/// Those that it sends to a receiver.
struct SentFormats : FormatList {
  using FormatList::FormatList;
  void read(ConfigReader& from, const char* key);
  static std::string schema();
};

/// Somebody who gets datagrams as they are logged.
struct ReceiverParameters {
  std::string to;
  SentFormats formats{"all"};
  double rate_mb_s = 20.0;
  std::string interface = "localhost";
  int ttl = 1;

  static void parameters(auto& self, auto&& visit) {
    visit("to", "", must(not_empty()), "IPv4 address, or that of a group, and UDP port as 127.0.0.1:16101", self.to);
    visit("formats", "", any(),
          "list of all, kmall, wcd and kmwcd, of those that are logged; of a water column beside its all or kmall only "
          "what these do not have",
          self.formats);
    visit("rate_mb_s", "MB/s", in(0.01, 1000),
          "rate at which a burst leaves; what would leave more than 2 s late is lost", self.rate_mb_s);
    visit("interface", "", any(), "address of the interface by which a group is sent to", self.interface);
    visit("ttl", "", in(0, 255), "routers that a group's datagrams pass, and one: 1 stays in the network", self.ttl);
  }
  void check(const ConfigReader& from) const;
};

/// Where files say that they are simulated: in texts alone, or in the fields for simulators too.
enum class SimulatedMarks { kText, kDatagrams };

struct LoggerParameters {
  LoggedFormats formats{"all"};
  std::string head;
  std::string folder = ".";
  std::string ship;
  int line = 0;
  int serial = 101;
  int position_rate_hz = 5;
  std::string sidescan;
  logger::XtfSamples xtf_samples = logger::XtfSamples::k16Bit;
  SimulatedMarks mark_simulated = SimulatedMarks::kText;
  double rotate_s = 0.0;
  double rotate_mb = 0.0;
  bool rotate_lines = false;
  std::vector<ReceiverParameters> send;

  static void parameters(auto& self, auto&& visit) {
    visit("formats", "", any(),
          "list of all (Kongsberg .all, model 2040), kmall (Kongsberg .kmall, EM 2040), wcd and kmwcd (the water "
          "column beside "
          "either) and xtf (Triton XTF)",
          self.formats);
    visit(
        "head", "", any(),
        "the multibeam whose soundings are logged, by its process's name; \"\": the only head, or none with a sidescan",
        self.head);
    visit("sidescan", "", any(), "sidescan whose pings are logged in XTF, by its process's name; \"\": none",
          self.sidescan);
    visit("folder", "", any(), "folder of the files, relative to the run's output folder; it is made", self.folder);
    visit("ship", "", any(), "name of the vessel in the files' names; \"\": the vehicle's", self.ship);
    visit("line", "", in(0, 9999), "number in the names of the first files; each next one counts on", self.line);
    visit("serial", "", in(1, 65534), "serial number that the system states", self.serial);
    visit("position_rate_hz", "Hz", in(1, 100), "positions; from 5 on they agree with the soundings to 1 cm",
          self.position_rate_hz);
    visit("xtf_samples", "",
          one_of({{"16_bit", logger::XtfSamples::k16Bit},
                  {"8_bit", logger::XtfSamples::k8Bit},
                  {"float", logger::XtfSamples::kFloat}}),
          "samples of sidescan channels in XTF", self.xtf_samples);
    visit(
        "mark_simulated", "", one_of({{"text", SimulatedMarks::kText}, {"datagrams", SimulatedMarks::kDatagrams}}),
        "place where files say that they are simulated: their texts, or fields for simulators too, which some software "
        "refuses",
        self.mark_simulated);
    visit("rotate_s", "s", in(0, 86'400), "time after which the next files begin; 0: never", self.rotate_s);
    visit("rotate_mb", "MB", in(0, 1e6), "size of a file after which the next ones begin; 0: never", self.rotate_mb);
    visit("rotate_lines", "", any(), "the next files begin with each of the mission's lines", self.rotate_lines);
    visit("send", "receivers of live streams, which get over UDP what the files get", self.send);
  }
};

struct LoggerConfig : LoggerParameters {
  // From the scenario.
  logger::Vessel vessel;                                                                   // with the multibeam
  logger::Vessel sidescan_vessel;                                                          // with the sidescan
  refraction::SoundSpeedProfile profile = refraction::SoundSpeedProfile::uniform(1500.0);  // the applied one
  std::optional<frames::Geodetic> origin;                                                  // not given: by the chart
  std::int64_t start_unix_ns = 0;

  bool water_column() const;  // whether a format has it

  static LoggerConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
