#pragma once

#include <string>
#include <variant>
#include <vector>

#include "components/config/parameters.h"

namespace ensonify {

class ConfigReader;

/// How the bytes of a source come.
namespace feed_way {

struct Udp {
  int port = 10110;
  static void parameters(auto& self, auto&& visit) {
    visit("udp", "", must(in(1024, 65535)), "UDP port to receive at", self.port);
  }
};

struct TcpServer {
  int port = 10110;
  static void parameters(auto& self, auto&& visit) {
    visit("tcp_server", "", must(in(1024, 65535)), "TCP port to which the sender connects", self.port);
  }
};

struct TcpClient {
  int port = 10110;
  std::string address = "127.0.0.1";
  static void parameters(auto& self, auto&& visit) {
    visit("tcp", "", must(in(1, 65535)), "TCP port of the sender, to connect to", self.port);
    visit("of", "", not_empty(), "address of the sender that is connected to", self.address);
  }
};

struct Serial {
  std::string line;
  int baud = 38400;
  static void parameters(auto& self, auto&& visit) {
    visit("serial", "", must(not_empty()), "serial line: /dev/ttyUSB0", self.line);
    visit("baud", "", in(4800, 921600), "rate of the serial line, with 8 bits, no parity and one stop bit", self.baud);
  }
};

struct File {
  std::string path;
  static void parameters(auto& self, auto&& visit) {
    visit("file", "", must(ensonify::path()), "log of NMEA lines, played from the run's start by its own times",
          self.path);
  }
};

}  // namespace feed_way

/// A source of bytes from outside: its name, how they come, and from whom they are taken.
struct ByteSource {
  using Udp = feed_way::Udp;
  using TcpServer = feed_way::TcpServer;
  using TcpClient = feed_way::TcpClient;
  using Serial = feed_way::Serial;
  using File = feed_way::File;
  using Way = std::variant<Udp, TcpServer, TcpClient, Serial, File>;

  std::string name = "ship";
  static constexpr auto kNamedBy = &ByteSource::name;
  Way way;
  std::string at = "127.0.0.1";
  std::vector<std::string> senders{"127.0.0.1"};

  static void parameters(auto& self, auto&& visit) {
    visit(one_form("needs one of {}"), self.way);
    visit("at", "", not_empty(), "address of this machine to receive at, IPv4 or IPv6; 0.0.0.0 or ::: all of them",
          self.at);
    visit("senders", "", any(), "addresses whose datagrams and connections are taken; others are refused and counted",
          self.senders);
  }
  /// Its addresses, and whether anybody may send to it.
  void check(const ConfigReader& from) const;
};

}  // namespace ensonify
