#include "components/clock/referee.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/errors/exit_error.h"

namespace ensonify::clock {

namespace {

Breach broken(const std::string& text) { return {kExitDied, "broke the protocol: DONE: " + text}; }

}  // namespace

Referee::Referee(std::uint32_t epoch, const Graph& graph, const std::vector<Declaration>& processes) : epoch_(epoch) {
  for (const Declaration& process : processes) runners_.push_back({process.may_finish, period_of({}), SimTime{0}, 0});
  const auto note = [](SimTime& finest, Rate rate) { finest = std::min(finest, period_of(rate)); };
  for (const Graph::Topic& topic : graph.topics) {
    topics_.push_back({topic.name, topic.publisher, RateLimit(topic.rate), 0});
    note(runners_[topic.publisher].finest, topic.rate);
  }
  for (const Graph::Edge& edge : graph.edges) note(runners_[edge.to].finest, graph.topics[edge.topic].rate);
}

std::optional<Breach> Referee::judge(std::size_t rank, const protocol::Done& done, SimTime promised, SimTime granted) {
  if (done.epoch != epoch_) return broken(fmt::format("epoch: is {}, the run's is {}", done.epoch, epoch_));
  if (done.next < promised)
    return broken(fmt::format("next: {} ns is before its promise of {} ns", done.next.count(), promised.count()));
  if (done.finish && !runners_[rank].may_finish)
    return broken("flags: 1 ends the run, but its HELLO said no may_finish");
  if (done.finish && done.next > granted && done.next - SimTime{1} > granted)
    return broken(fmt::format("next: with flag 1 it is the event's time plus 1 ns; {} ns is beyond the horizon, {} ns",
                              done.next.count(), granted.count()));
  if (auto breach = count(rank, done, std::min(done.next, granted))) return breach;
  return watch_creep(rank, done.next);
}

std::optional<Breach> Referee::count(std::size_t rank, const protocol::Done& done, SimTime until) {
  for (const auto& [id, count] : done.outputs) {
    if (id >= topics_.size() || topics_[id].publisher != rank)
      return broken(
          fmt::format("topic {}{}: is not its own", id, id < topics_.size() ? " (" + topics_[id].name + ")" : ""));
    Topic& topic = topics_[id];
    if (count < topic.published)
      return broken(fmt::format("{}: count {} is less than {} before", topic.name, count, topic.published));
    if (!topic.limit.take(count - topic.published, until))
      return broken(fmt::format("{}: count {} after {}: {}", topic.name, count, topic.published, topic.limit.text()));
    topic.published = count;
  }
  return std::nullopt;
}

std::optional<Breach> Referee::watch_creep(std::size_t rank, SimTime next) {
  Runner& runner = runners_[rank];
  if (next - runner.counted_from >= runner.finest) {
    runner.counted_from = next;
    runner.grants = 0;
    return std::nullopt;
  }
  if (++runner.grants <= kMostGrantsPerPeriod) return std::nullopt;
  return Breach{kExitStall,
                fmt::format("stands still: {} grants in which its time moved by {} ns, less than its finest "
                            "period of {} ns",
                            runner.grants, (next - runner.counted_from).count(), runner.finest.count())};
}

}  // namespace ensonify::clock
