#include "components/logger/sent_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "components/errors/exit_error.h"
#include "components/formats/all/network.h"
#include "components/formats/kmall/parts.h"
#include "components/transport/udp_sender.h"

namespace ensonify::logger {

namespace {

bool is_kmall(const std::string& format) { return format.starts_with("km"); }

std::size_t bytes_of_first(const std::string& format, formats::ByteView file) {
  return is_kmall(format) ? formats::kmall::datagram_bytes(file) : formats::all::datagram_bytes(file);
}

/// What goes over the network of a datagram.
std::vector<formats::Bytes> on_network(const std::string& format, formats::ByteView datagram) {
  if (is_kmall(format)) return formats::kmall::parts_of(datagram);
  const formats::ByteView sent = formats::all::to_network(datagram);
  return {formats::Bytes(sent.begin(), sent.end())};
}

/// Whether only files of water columns have it.
bool is_of_water_column(const std::string& format, formats::ByteView datagram) {
  const auto at = [&](std::size_t from, std::size_t count) {
    return std::string_view(reinterpret_cast<const char*>(datagram.data()) + from, count);
  };
  return is_kmall(format) ? at(4, 4) == "#MWC" || at(4, 4) == "#CHE" : at(5, 1) == "k";
}

}  // namespace

SentFiles::SentFiles(const LoggerConfig& config, Files& files) : formats_(config.formats), files_(files) {
  for (const ReceiverParameters& one : config.send) {
    try {
      const Address to = udp_address(one.to);
      receivers_.push_back(
          {text_of(to), one.formats,
           std::make_unique<SendStream>(std::make_unique<UdpSender>(to, interface_address(one.interface), one.ttl),
                                        1e6 * one.rate_mb_s)});
    } catch (const UserError& error) {
      throw UserError(fmt::format("send[{}].interface: {}", receivers_.size(), error.what()));
    }
  }
}

bool SentFiles::wants(const Receiver& receiver, const std::string& format, formats::ByteView datagram) {
  if (!receiver.formats.has(format)) return false;
  const bool beside =
      format == "wcd" ? receiver.formats.has("all") : format == "kmwcd" && receiver.formats.has("kmall");
  return !beside || is_of_water_column(format, datagram);
}

void SentFiles::put(std::size_t format, const formats::Bytes& bytes) {
  files_.put(format, bytes);
  const std::string& name = formats_[format];
  if (std::none_of(receivers_.begin(), receivers_.end(), [&](const Receiver& one) { return one.formats.has(name); }))
    return;
  for (formats::ByteView left = bytes; !left.empty();) {
    const formats::ByteView datagram = left.first(bytes_of_first(name, left));
    left = left.subspan(datagram.size());
    const std::vector<formats::Bytes> sent = on_network(name, datagram);
    for (Receiver& receiver : receivers_) {
      if (!wants(receiver, name, datagram)) continue;
      for (const formats::Bytes& part : sent) {
        ++receiver.datagrams;
        receiver.bytes += static_cast<std::int64_t>(part.size());
        receiver.stream->offer(part);
      }
    }
  }
}

void SentFiles::finish() {
  for (Receiver& receiver : receivers_) receiver.stream->finish();
}

std::vector<SentFiles::Counts> SentFiles::counts() const {
  std::vector<Counts> counts;
  for (const Receiver& receiver : receivers_)
    counts.push_back({receiver.to, receiver.datagrams, receiver.bytes, receiver.stream->counts()});
  return counts;
}

}  // namespace ensonify::logger
