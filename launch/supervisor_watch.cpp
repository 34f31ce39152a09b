// What a supervisor watches while a run goes on: what the clock says, who leaves, memory.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <nlohmann/json.hpp>

#include "launch/memory.h"
#include "launch/supervisor.h"

namespace ensonify::launcher {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kAskEvery{200};
constexpr milliseconds kWatchMemoryEvery{500};
constexpr milliseconds kLeftTooEarly{2000};
constexpr milliseconds kLastWords{300};  // of one that has left, on their way to the clock
constexpr milliseconds kClocksAnswer{500};
constexpr int kAsks = 4;
constexpr milliseconds kGraceOfLost{2000};  // it may be about to end in its own words

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

}  // namespace

void Supervisor::ask_clock(WallTime now) {
  if (now - last_asked_ < kAskEvery || !clock().child->running()) {
    return;
  }
  last_asked_ = now;
  if (const auto answer = query_->ask(R"({"kind":"status"})", kAnswerPatience)) {
    last_answer_ = now;
    read_status(*answer);
    return;
  }
  const double patience_s = 10.0 * launch_.clock.progress_deadline_s;
  if (noticed_.empty() && elapsed_s(last_answer_, now) > patience_s) {
    clock().fault = Fault{kExitStall, "clock", fmt::format("has not answered for {:.1f} s", patience_s)};
    noticed_.push_back(*clock().fault);
    judge_at_ = now;
  }
}

void Supervisor::read_status(const std::string& text) {
  const auto status = nlohmann::json::parse(text, nullptr, false);
  if (!status.is_object() || status.value("kind", "") != "status") {
    return;
  }
  clock_state_ = upper(status.value("state", "starting"));
  if (status.contains("sim_ns") && status["sim_ns"].is_number()) {
    sim_s_ = 1e-9 * status["sim_ns"].get<double>();
  }
  const bool runs = clock_state_ == "RUNNING" || clock_state_ == "PAUSED";
  note_losses(losses_in(status), last_answer_);
  const auto missing = status.value("missing", std::vector<std::string>{});
  for (auto& member : members_) {
    const bool joined = std::find(missing.begin(), missing.end(), member.name) == missing.end();
    if (member.state == "STARTING" || member.state == "CONNECTED" || member.state == "READY") {
      member.state = runs ? "RUNNING" : status.contains("missing") ? (joined ? "CONNECTED" : "STARTING") : "READY";
    }
  }
}

/// By what the clock said afterwards: it may know why one left, and on its way out, on a machine that swaps, it says
/// nothing.
void Supervisor::check_leavers(WallTime now) {
  for (auto& member : members_) {
    const bool explained = !member.left_at || member.loss || member.fault || member.spec->observer;
    if (explained || clock_state_ == "DONE" || clock_state_ == "FAILED") continue;
    const std::string why = "left before the end of the run";
    const auto since = last_answer_ - *member.left_at;
    if (since > kLastWords && member.spec->may_be_lost && lose(member, why)) continue;
    if (since > kLeftTooEarly) {
      member.state = "FAILED";
      member.fault = Fault{kExitDied, member.name, why};
      noticed_.push_back(*member.fault);
      judge_at_ = now;
    }
  }
}

void Supervisor::respawn(WallTime now) {
  for (auto& member : members_) {
    if (member.respawn_at && now >= *member.respawn_at) {
      member.respawn_at.reset();
      start(member, process_command(launch_, *member.spec, places_, clock_endpoint_));
    }
  }
}

/// Whether the run goes on without this process, which has died.
bool Supervisor::lose(Member& member, const std::string& why) {
  if (!query_) return false;
  if (!clock().child->running() && noticed_.empty()) {  // the run has ended well
    note_loss(member, {member.name, sim_s_, why});
    return true;
  }
  const std::string request = nlohmann::json{{"kind", "lose"}, {"process", member.name}, {"why", why}}.dump(
      -1, ' ', false, nlohmann::json::error_handler_t::replace);
  for (int i = 0; i < kAsks; ++i) {
    const auto text = query_->ask(request, kClocksAnswer);
    const auto answer = nlohmann::json::parse(text.value_or(""), nullptr, false);
    if (!answer.is_object() || answer.value("kind", "") != "lose")
      continue;  // it is busy, or answers what was asked before
    if (!answer.value("ok", false)) return false;
    note_loss(member, {member.name, 1e-9 * answer.value("at_ns", 0.0), why});
    return true;
  }
  return false;
}

void Supervisor::note_loss(Member& member, const Loss& loss) {
  member.state = "LOST";
  if (member.loss) return;
  member.loss = loss;
  progress_.finish();
  fmt::print(stderr, "ensonify run: {} is lost at t={:.3f} s: {}; the run goes on without it\n", member.name, loss.at_s,
             loss.why);
}

void Supervisor::note_losses(const std::vector<Loss>& losses, WallTime now) {
  for (const Loss& loss : losses) {
    const auto member =
        std::find_if(members_.begin(), members_.end(), [&](const Member& m) { return m.name == loss.process; });
    if (member == members_.end() || member->loss) continue;
    note_loss(*member, loss);
    member->kill_at = now + kGraceOfLost;
  }
}

/// A process that stood still or broke the protocol is still there when the clock has done with it.
void Supervisor::kill_lost(WallTime now) {
  for (auto& member : members_) {
    if (!member.kill_at || now < *member.kill_at) continue;
    member.kill_at.reset();
    if (member.child) member.child->send(SIGKILL);
  }
}

/// A run must not take the machine down. An observer that outgrows its memory is lost alone.
void Supervisor::watch_memory(WallTime now) {
  if (now - memory_watched_ < kWatchMemoryEvery || !noticed_.empty()) {
    return;
  }
  memory_watched_ = now;
  std::vector<pid_t> groups;
  for (const auto& member : members_) {
    if (member.child && member.child->running()) {
      groups.push_back(member.child->pid());
    }
  }
  const auto resident = resident_of(groups);
  std::vector<Held> held;
  for (const auto& member : members_) {
    if (const auto found = member.child ? resident.find(member.child->pid()) : resident.end();
        found != resident.end()) {
      held.push_back({member.name, found->second, member.spec != nullptr ? member.spec->memory_mb : std::nullopt});
    }
  }
  const auto fault = too_much_memory(held, machine_mb());
  if (!fault) {
    return;
  }
  auto& culprit =
      *std::find_if(members_.begin(), members_.end(), [&](const Member& m) { return m.name == fault->culprit; });
  if (culprit.spec != nullptr &&
      (culprit.spec->observer || (culprit.spec->may_be_lost && lose(culprit, fault->message)))) {
    culprit.child->send(SIGKILL);
    return;
  }
  culprit.fault = fault;
  noticed_.push_back(*fault);
  judge_at_ = now;
}

}  // namespace ensonify::launcher
