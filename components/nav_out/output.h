#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "components/config/parameters.h"
#include "components/nav_out/kinds.h"

namespace ensonify {

class ConfigReader;
struct ConfigNode;

/// How the bytes of an output leave.
namespace out_way {

struct Udp {
  int port = 10110;
  std::string to = "127.0.0.1";
  std::string interface = "localhost";
  int ttl = 1;
  static void parameters(auto& self, auto&& visit) {
    visit("udp", "", must(in(1, 65535)), "UDP port of the receiver, or of a group", self.port);
    visit("to", "", not_empty(), "address of the receiver, or of a group, IPv4 or IPv6", self.to);
    visit("interface", "", not_empty(),
          "address of this machine's interface by which a group of IPv4 is sent to; one of IPv6 names it: ff02::1%eth0",
          self.interface);
    visit("ttl", "", in(0, 255), "number of routers that a group's datagrams pass, and one: 1 stays in the network",
          self.ttl);
  }
};

struct TcpServer {
  int port = 10110;
  std::string at = "127.0.0.1";
  std::vector<std::string> receivers{"127.0.0.1"};
  static void parameters(auto& self, auto&& visit) {
    visit("tcp_server", "", must(in(1024, 65535)), "TCP port to which receivers connect, eight at most", self.port);
    visit("at", "", not_empty(),
          "address of this machine to which they connect, IPv4 or IPv6; 0.0.0.0 or ::: all of them", self.at);
    visit("receivers", "", any(), "addresses that may connect; others are refused and counted", self.receivers);
  }
};

struct TcpClient {
  int port = 10110;
  std::string address = "127.0.0.1";
  static void parameters(auto& self, auto&& visit) {
    visit("tcp", "", must(in(1, 65535)), "TCP port of the receiver, to connect to", self.port);
    visit("of", "", not_empty(), "address of the receiver that is connected to, IPv4 or IPv6", self.address);
  }
};

struct Serial {
  std::string line;
  int baud = 38400;
  static void parameters(auto& self, auto&& visit) {
    visit("serial", "", must(not_empty()), "serial line: /dev/ttyUSB0", self.line);
    visit("baud", "", in(4800, 921600),
          "rate of the serial line, with 8 bits, no parity and one stop bit: 10 baud a byte", self.baud);
  }
};

struct File {
  std::string path;
  static void parameters(auto& self, auto&& visit) {
    visit("file", "", must(not_empty()), "file of all that leaves, relative to the run's output folder", self.path);
  }
};

}  // namespace out_way

/// Sentences and how often each leaves in a second: `{ GGA: 5, HDT: 10 }`.
struct SentenceRates : std::vector<std::pair<nav_out::KindInfo, double>> {
  using std::vector<std::pair<nav_out::KindInfo, double>>::vector;
  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const;
  bool same_as(const SentenceRates& other) const;
  static std::string schema();
};

/// One receiver of what the vehicle's instruments say: how its bytes leave, what they are, and how often.
struct Output {
  using Udp = out_way::Udp;
  using TcpServer = out_way::TcpServer;
  using TcpClient = out_way::TcpClient;
  using Serial = out_way::Serial;
  using File = out_way::File;
  using Way = std::variant<Udp, TcpServer, TcpClient, Serial, File>;
  enum class Format { kNmea, kTss1, kEmAttitude, kKmBinary };

  std::string name = "ship";
  static constexpr auto kNamedBy = &Output::name;
  Way way;
  Format format = Format::kNmea;
  SentenceRates sentences = kUsual;
  double rate_hz = 10.0;
  std::string talker;
  double latency_s = 0.0;
  std::optional<double> transducer_offset_m;

  static const SentenceRates kUsual;

  static void parameters(auto& self, auto&& visit) {
    visit(one_form("needs one of {}"), self.way);
    visit("format", "",
          one_of({{"nmea", Format::kNmea},
                  {"tss1", Format::kTss1},
                  {"em_attitude", Format::kEmAttitude},
                  {"km_binary", Format::kKmBinary}}),
          "format of the bytes; em_attitude: of EM 3000", self.format);
    visit("sentences", "", any(),
          "map of NMEA's sentences to their rates in Hz, each up to that of its instrument: ZDA, GGA, GST, VTG, HDT, "
          "ROT, "
          "PASHR, PSXN20, PSXN23, DPT, DBT, VDO, VDM",
          self.sentences);
    visit("rate_hz", "Hz", in(0.01, 1000), "frames per second of a format other than nmea, up to its instrument's rate",
          self.rate_hz);
    visit("talker", "", any(),
          "two letters that sentences begin with; \"\": GP, of headings HE, TI of turns, SD of depths", self.talker);
    visit("latency_s", "s", in(0, 10), "time from an instrument's message to the sentence; ZDA has none",
          self.latency_s);
    visit(
        "transducer_offset_m", "m", in(-100, 100),
        "offset that DPT states: from the transducer up to the water line; negative: down to the keel; left out: blank",
        self.transducer_offset_m);
  }
  void check(const ConfigReader& from) const;

  /// All that leaves, with rates.
  SentenceRates lines() const;
  /// The most bytes in a second.
  double bytes_per_s() const;
};

}  // namespace ensonify
