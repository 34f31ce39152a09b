// A process that the run may lose (`may_be_lost`): it is taken out of the lockstep, and the others go on.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "components/clock/clock.h"
#include "components/runtime/log.h"

namespace ensonify::clock {

/// A participant's own mistake, or its end.
void Clock::fault(std::size_t rank, int code, const std::string& message) {
  if (!lose(rank, message)) fail(code, registry_.hellos()[rank].declaration.process, message);
}

/// Whether the run goes on without it. What it has counted in a DONE stays, and is all that ever comes of it: its next
/// event, and so the end of its promise, is never. Before time starts, and while another epoch is to begin, nobody can
/// be done without.
bool Clock::lose(std::size_t rank, const std::string& why) {
  const std::string& name = registry_.hellos()[rank].declaration.process;
  const bool goes_on = phase_ == Phase::kRunning && !next_;
  if (!launch_.process(name).may_be_lost || !(goes_on || phase_ == Phase::kEnding)) return false;
  if (is_lost(rank)) return true;
  Account& account = epoch_.accounts[rank];
  account.lost = why;
  account.lost_at = std::min(epoch_.conductor->next(rank), epoch_.conductor->end());
  left_[rank] = true;
  log::line("clock", account.lost_at, "lost", fmt::format("process={} why=\"{}\"", name, why));
  if (!goes_on) return true;
  for (std::size_t reader = 0; reader < registry_.size(); ++reader) {
    if (registry_.feeds(rank, reader) && !is_lost(reader))
      control_.send(epoch_.accounts[reader].name, protocol::encode_lost(name));
  }
  epoch_.conductor->done(rank, kNever);
  epoch_.last_progress = std::chrono::steady_clock::now();
  epoch_.stall_stage = 0;
  hand_out();
  return true;
}

/// A reader goes on without its message. A window after the event that was to have it nobody can have seen anything
/// yet: there the sender stops, at a sim time that is the same in every run, whenever the reader came to notice.
void Clock::on_unusable(std::size_t rank, const protocol::Unusable& unusable) {
  const protocol::Failed& why = unusable.why;
  const auto culprit = registry_.participant(why.culprit);
  if (!culprit || !registry_.feeds(*culprit, rank))
    throw std::runtime_error("culprit: " + why.culprit + " is none whose messages it takes");
  if (!launch_.process(why.culprit).may_be_lost) return on_failed(rank, why);
  if (phase_ != Phase::kRunning || next_ || is_lost(*culprit)) return;
  Account& account = epoch_.accounts[*culprit];
  if (account.doomed.empty()) {
    account.doomed = why.message;
    log::line("clock", unusable.at, "unusable", fmt::format("process={} why=\"{}\"", why.culprit, why.message));
  }
  const SimTime window = from_seconds(launch_.clock.window_s);
  epoch_.conductor->stop_before(*culprit, saturating_add(saturating_add(unusable.at, window), SimTime{1}));
  lose_stopped(*culprit);
}

/// One whose messages cannot be used has come to where it is to stop.
bool Clock::lose_stopped(std::size_t rank) {
  const std::string& doomed = epoch_.accounts[rank].doomed;
  return !doomed.empty() && !is_lost(rank) && epoch_.conductor->stopped(rank) && lose(rank, doomed);
}

/// The run ends before they have come there.
bool Clock::lose_doomed() {
  for (std::size_t rank = 0; rank < epoch_.accounts.size(); ++rank) {
    const std::string& doomed = epoch_.accounts[rank].doomed;
    if (!doomed.empty() && !is_lost(rank)) return lose(rank, doomed);
  }
  return false;
}

/// The launcher sees who dies; to the clock a process that is gone is silent.
std::string Clock::ask_to_lose(const nlohmann::json& request, nlohmann::json& answer) {
  const nlohmann::json process = request.value("process", nlohmann::json());
  const nlohmann::json why = request.value("why", nlohmann::json());
  if (!process.is_string() || !why.is_string() || why == "") return "process, why: are not texts";
  const auto rank = registry_.participant(process.get<std::string>());
  if (!rank) return "process: " + process.dump() + " has not joined";
  if (phase_ == Phase::kEnding && left_[*rank] && !is_lost(*rank)) return "it has left at the end of the run";
  if (!lose(*rank, why.get<std::string>()))
    return process.get<std::string>() +
           " is not one that the run may lose now; allowed: a process with may_be_lost: true, while time runs and no "
           "reset is under way";
  answer["at_ns"] = epoch_.accounts[*rank].lost_at.count();
  return "";
}

}  // namespace ensonify::clock
