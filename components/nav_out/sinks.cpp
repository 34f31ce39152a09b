#include "components/nav_out/sinks.h"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "components/errors/exit_error.h"
#include "components/errors/overloaded.h"
#include "components/transport/udp_sender.h"

namespace ensonify::nav_out {
namespace {

constexpr double kNetwork_bytes_per_s = 2e6;  // a burst leaves at this rate, and four megabytes wait at most
constexpr double kBitsAByte = 10.0;

std::unique_ptr<SendStream> stream(std::unique_ptr<Sender> sender, double bytes_per_s = kNetwork_bytes_per_s) {
  return std::make_unique<SendStream>(std::move(sender), bytes_per_s);
}

using To = std::variant<std::unique_ptr<SendStream>, std::ofstream>;

To opened(const Output& output, const std::filesystem::path& folder) {
  return std::visit(
      Overloaded{[](const Output::Udp& way) -> To {
                   const Address to = receiver_address(way.to, way.port);
                   return stream(std::make_unique<UdpSender>(to, interface_address(way.interface), way.ttl));
                 },
                 [](const Output::TcpServer& way) -> To {
                   return stream(tcp_server_sender(way.at, way.port, Senders(way.receivers)));
                 },
                 [](const Output::TcpClient& way) -> To { return stream(tcp_client_sender(way.address, way.port)); },
                 [](const Output::Serial& way) -> To {
                   return stream(serial_sender(way.line, way.baud), way.baud / kBitsAByte);
                 },
                 [&](const Output::File& way) -> To {
                   const std::filesystem::path path = folder / way.path;
                   std::error_code none;
                   std::filesystem::create_directories(path.parent_path(), none);
                   std::ofstream file(path, std::ios::binary);
                   if (!file) throw UserError(fmt::format("file: {} cannot be written", path.string()));
                   return file;
                 }},
      output.way);
}

}  // namespace

Sinks::Sinks(const std::vector<Output>& outputs, const std::filesystem::path& folder) {
  for (const Output& output : outputs) {
    try {
      sinks_.push_back({output.name, opened(output, folder)});
    } catch (const UserError& error) {
      throw UserError(fmt::format("outputs.{}: {}", output.name, error.what()));
    }
  }
}

void Sinks::put(std::size_t output, const std::string& bytes) {
  Sink& sink = sinks_[output];
  ++sink.pieces;
  sink.bytes += static_cast<std::int64_t>(bytes.size());
  if (auto* file = std::get_if<std::ofstream>(&sink.to)) {
    file->write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!*file) throw UserError(fmt::format("outputs.{}: file: cannot be written on", sink.name));
    return;
  }
  const auto view = std::as_bytes(std::span(bytes));
  std::get<std::unique_ptr<SendStream>>(sink.to)->offer({view.begin(), view.end()});
}

void Sinks::finish() {
  for (Sink& sink : sinks_) {
    if (auto* file = std::get_if<std::ofstream>(&sink.to)) file->close();
    else std::get<std::unique_ptr<SendStream>>(sink.to)->finish();
  }
}

std::vector<Sinks::Counts> Sinks::counts() const {
  std::vector<Counts> counts;
  for (const Sink& sink : sinks_) {
    const auto* sent = std::get_if<std::unique_ptr<SendStream>>(&sink.to);
    counts.push_back({sink.name, sink.pieces, sink.bytes, sent != nullptr ? (*sent)->counts() : SendStream::Counts{}});
  }
  return counts;
}

}  // namespace ensonify::nav_out
