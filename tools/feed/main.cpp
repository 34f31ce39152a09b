// ensonify feed: what comes of a navigation feed, before a run depends on it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "components/transport/channel.h"
#include "scenarios/scenario_file.h"
#include "tools/feed/report.h"

using namespace ensonify;

namespace {

constexpr int kFaultsFound = 1;

struct Options {
  int udp = 0, tcp_server = 0, tcp = 0, baud = 38400;
  std::string of = "127.0.0.1", at = "127.0.0.1", serial, file;
  std::vector<std::string> senders{"127.0.0.1"};
  double seconds = 60.0;
  bool json = false;
};

/// How the bytes come, as a source of nav_feed has it.
std::string way_of(const Options& options) {
  const std::string senders = options.senders == std::vector<std::string>{"127.0.0.1"}
                                  ? ""
                                  : fmt::format(", senders: [{}]", fmt::join(options.senders, ", "));
  const std::string at = options.at == "127.0.0.1" ? "" : ", at: " + options.at;
  if (!options.file.empty()) return "file: " + options.file;
  if (!options.serial.empty()) return fmt::format("serial: {}, baud: {}", options.serial, options.baud);
  if (options.tcp > 0) return fmt::format("tcp: {}, of: {}", options.tcp, options.of);
  if (options.tcp_server > 0) return fmt::format("tcp_server: {}{}{}", options.tcp_server, at, senders);
  return fmt::format("udp: {}{}{}", options.udp, at, senders);
}

std::unique_ptr<Channel> channel_of(const Options& options) {
  if (!options.serial.empty()) return serial_channel(options.serial, options.baud);
  if (options.tcp > 0) return tcp_client_channel(options.of, options.tcp);
  if (options.tcp_server > 0) return tcp_server_channel(options.at, options.tcp_server, Senders(options.senders));
  return udp_channel(options.at, options.udp, Senders(options.senders));
}

/// Of a log, line by line, by the stamps in front where there are any; its lines are sentences, or a whole of bytes.
void read_file(const std::string& path, feed_doctor::Examiner& examiner) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw UserError(path + ": cannot be read");
  for (std::string line; std::getline(in, line) && !interrupted();) {
    const std::size_t begin = line.find('$');
    std::string stamp = begin == std::string::npos ? "" : line.substr(0, begin);
    while (!stamp.empty() && (stamp.back() == ' ' || stamp.back() == '\t')) stamp.pop_back();
    const auto ns = parse_utc_ns(stamp);
    if (begin != std::string::npos) line.erase(0, begin);
    if (!in.eof()) line += '\n';
    examiner.take(line, ns ? std::optional(1e-9 * static_cast<double>(*ns)) : std::nullopt, false);
  }
}

feed_doctor::Reception receive(const Options& options, feed_doctor::Examiner& examiner) {
  const auto channel = channel_of(options);
  fmt::print(stderr, "receives for {:g} s: {}\n", options.seconds, way_of(options));
  using Clock = std::chrono::steady_clock;
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.seconds));
  while (Clock::now() < end && !interrupted()) {
    const auto piece = channel->wait(std::chrono::milliseconds(50));
    if (!piece) continue;
    const std::chrono::duration<double> unix_s = std::chrono::system_clock::now().time_since_epoch();
    examiner.take(piece->bytes, unix_s.count(), piece->whole);
  }
  return {channel->refused(), channel->trouble()};
}

void print(const Options& options, const feed_doctor::Reception& reception) {
  if (reception.refused > 0)
    fmt::print("{} datagrams or connections came from others than {}: name them with --sender\n", reception.refused,
               fmt::join(options.senders, ", "));
  if (!reception.trouble.empty()) fmt::print("{}\n", reception.trouble);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What comes of a navigation feed.", "ensonify feed");
  CLI::App* doctor = app.add_subcommand(
      "doctor",
      "Receives a feed, or reads a log, and says what it is: sentences, rates, jitter, time scale, faults, signs that\n"
      "physics can check, the antenna's height; prints the source for nav_feed. Exit code: 0 nothing to correct,\n"
      "1 something is, 2 it cannot be received at all.");
  app.require_subcommand(1);
  Options options;
  CLI::Option* ways[] = {
      doctor->add_option("PORT,--udp", options.udp, "UDP port to receive at")->check(CLI::Range(1024, 65535)),
      doctor->add_option("--tcp-server", options.tcp_server, "TCP port to which the sender connects")
          ->check(CLI::Range(1024, 65535)),
      doctor->add_option("--tcp", options.tcp, "TCP port of the sender, to connect to")->check(CLI::Range(1, 65535)),
      doctor->add_option("--serial", options.serial, "serial line: /dev/ttyUSB0"),
      doctor->add_option("--file", options.file,
                         "log of NMEA lines, with or without a time in front, or of binary frames")};
  doctor->add_option("--of", options.of, "address of the sender that is connected to")->capture_default_str();
  doctor->add_option("--at", options.at, "address of this machine to receive at; 0.0.0.0: all of them")
      ->capture_default_str();
  doctor->add_option("--sender", options.senders, "addresses that are taken from; others are refused and counted")
      ->capture_default_str();
  doctor->add_option("--baud", options.baud, "rate of the serial line")
      ->capture_default_str()
      ->check(CLI::Range(4800, 921600));
  doctor->add_option("--seconds", options.seconds, "time to receive for")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 86400.0));
  doctor->add_flag("--json", options.json, "print the findings as one JSON object; what is not known is null");
  return tool_main(app, argc, argv, [&]() -> int {
    const auto given =
        std::count_if(std::begin(ways), std::end(ways), [](const CLI::Option* way) { return way->count() > 0; });
    if (given != 1) throw UserError("needs one of PORT (--udp), --tcp-server, --tcp, --serial, --file");
    feed_doctor::Examiner examiner;
    feed_doctor::Reception reception;
    if (options.file.empty()) reception = receive(options, examiner);
    else read_file(options.file, examiner);
    const feed_doctor::Findings found = examiner.findings();
    const feed_doctor::Report report = feed_doctor::report_of(found, way_of(options));
    if (options.json) {
      fmt::print("{}\n", feed_doctor::json_of(found, report, reception));
    } else {
      print(options, reception);
      fmt::print("{}", report.text);
    }
    return !report.faults.empty() ? kFaultsFound : kExitOk;
  });
}
