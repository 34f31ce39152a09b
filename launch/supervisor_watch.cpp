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
  const auto missing = status.value("missing", std::vector<std::string>{});
  for (auto& member : members_) {
    const bool joined = std::find(missing.begin(), missing.end(), member.name) == missing.end();
    if (member.state == "STARTING" || member.state == "CONNECTED" || member.state == "READY") {
      member.state = runs ? "RUNNING" : status.contains("missing") ? (joined ? "CONNECTED" : "STARTING") : "READY";
    }
  }
}

void Supervisor::check_leavers(WallTime now) {
  for (auto& member : members_) {
    // By what the clock said after that: one that is itself on its way out, on a machine that swaps, says nothing.
    const bool early = member.left_at && last_answer_ > *member.left_at + kLeftTooEarly && !member.spec->observer;
    if (early && !member.fault && clock_state_ != "DONE" && clock_state_ != "FAILED") {
      member.state = "FAILED";
      member.fault = Fault{kExitDied, member.name, "left before the end of the run"};
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
  if (culprit.spec != nullptr && culprit.spec->observer) {
    culprit.child->send(SIGKILL);
    return;
  }
  culprit.fault = fault;
  noticed_.push_back(*fault);
  judge_at_ = now;
}

}  // namespace ensonify::launcher
