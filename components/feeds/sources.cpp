#include "components/feeds/sources.h"

#include <algorithm>
#include <utility>

#include "components/errors/exit_error.h"
#include "components/errors/overloaded.h"

namespace ensonify {
namespace {

std::variant<std::unique_ptr<Receiver>, std::unique_ptr<LogPlayer>> opened(const ByteSource& source) {
  const Senders senders(source.senders);
  const auto receive = [](std::unique_ptr<Channel> channel) { return std::make_unique<Receiver>(std::move(channel)); };
  using Result = std::variant<std::unique_ptr<Receiver>, std::unique_ptr<LogPlayer>>;
  return std::visit(
      Overloaded{
          [&](const ByteSource::Udp& way) -> Result { return receive(udp_channel(source.at, way.port, senders)); },
          [&](const ByteSource::TcpServer& way) -> Result {
            return receive(tcp_server_channel(source.at, way.port, senders));
          },
          [&](const ByteSource::TcpClient& way) -> Result {
            return receive(tcp_client_channel(way.address, way.port));
          },
          [&](const ByteSource::Serial& way) -> Result { return receive(serial_channel(way.line, way.baud)); },
          [&](const ByteSource::File& way) -> Result { return std::make_unique<LogPlayer>(way.path); }},
      source.way);
}

}  // namespace

Sources::Sources(const std::vector<ByteSource>& sources) {
  for (const ByteSource& source : sources) {
    try {
      open_.push_back({source.name, opened(source), std::nullopt});
    } catch (const UserError& error) {
      throw UserError("sources." + source.name + ": " + error.what());
    }
  }
}

std::vector<FedPiece> Sources::take(SimTime now) {
  std::vector<FedPiece> taken;
  const std::size_t bytes_each = kMostBytes / open_.size(), pieces_each = 1 + kMostPieces / open_.size();
  clock_.event(now, Receiver::Clock::now());
  for (std::size_t i = 0; i < open_.size(); ++i) {
    std::size_t bytes = 0;
    const std::size_t before = taken.size();
    const auto room = [&] { return bytes < bytes_each && taken.size() - before < pieces_each; };
    std::visit(
        Overloaded{[&](const std::unique_ptr<Receiver>& receiver) {
                     while (room()) {
                       auto arrival = take(*receiver, open_[i], now);
                       if (!arrival) break;
                       bytes += arrival->piece.bytes.size();
                       taken.push_back({i, std::clamp(clock_.of(arrival->at), last_, now),
                                        std::move(arrival->piece.bytes), arrival->piece.begins, arrival->piece.whole});
                     }
                   },
                   [&](const std::unique_ptr<LogPlayer>& log) {
                     while (room()) {
                       auto line = log->take(now);
                       if (!line) break;
                       bytes += line->text.size();
                       taken.push_back({i, std::clamp(line->arrival, last_, now), std::move(line->text), false, true});
                     }
                   }},
        open_[i].from);
  }
  std::stable_sort(taken.begin(), taken.end(),
                   [](const FedPiece& a, const FedPiece& b) { return a.arrival < b.arrival; });
  last_ = now;
  return taken;
}

/// The next piece that came by `now`.
std::optional<Receiver::Arrival> Sources::take(Receiver& receiver, Open& open, SimTime now) {
  if (!open.waiting) open.waiting = receiver.take();
  if (!open.waiting || clock_.of(open.waiting->at) > now) return std::nullopt;
  return std::exchange(open.waiting, std::nullopt);
}

std::string Sources::trouble() const {
  std::string causes;
  for (const Open& open : open_) {
    const auto* receiver = std::get_if<std::unique_ptr<Receiver>>(&open.from);
    const std::string cause = receiver == nullptr ? "" : (*receiver)->state().trouble;
    if (!cause.empty()) causes += (causes.empty() ? "" : "; ") + open.name + ": " + cause;
  }
  return causes;
}

void Sources::count(const std::function<void(const std::string&, std::int64_t)>& count) {
  for (Open& open : open_) {
    const auto* receiver = std::get_if<std::unique_ptr<Receiver>>(&open.from);
    if (receiver == nullptr) continue;
    const Receiver::State state = (*receiver)->state();
    const auto grown = [&](const char* what, std::uint64_t total, std::uint64_t& before) {
      if (total > before) count(what, static_cast<std::int64_t>(total - before));
      before = total;
    };
    grown("senders_refused", state.refused, open.refused);
    grown("bytes_dropped", state.dropped_bytes, open.dropped_bytes);
  }
}

}  // namespace ensonify
