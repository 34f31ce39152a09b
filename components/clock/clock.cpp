#include "components/clock/clock.h"

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "components/errors/exit_error.h"
#include "components/runtime/log.h"
#include "launch/process/launch_wiring.h"

namespace ensonify::clock {

namespace {

using std::chrono::steady_clock;

std::atomic<bool> stop_requested{false};

constexpr std::chrono::seconds kHealthEvery{1};  // wall time; wait() returns often enough, also while paused

WallTime after(WallTime t, double s) {
  return t + std::chrono::duration_cast<WallTime::duration>(std::chrono::duration<double>(s));
}

}  // namespace

void request_stop() { stop_requested = true; }

Clock::Clock(const Launch& launch, bus::ControlPlane& control, std::filesystem::path out_dir, ReadLaunch read)
    : first_(launch),
      launch_(launch),
      control_(control),
      read_(std::move(read)),
      registry_(launch),
      pacer_(launch.clock.rate, from_seconds(launch.clock.slip_after_s)),
      phase_began_(steady_clock::now()) {
  epoch_.out = std::move(out_dir);
}

int Clock::run() {
  while (phase_ != Phase::kOver) {
    const auto message = control_.wait(next_alarm());
    if (message) on_message(*message);
    on_time(steady_clock::now());
  }
  write_report(epoch_.out);
  if (epoch_.out != first_.options.out) write_report(first_.options.out);  // where the launcher reads it
  return exit_code_;
}

std::optional<WallTime> Clock::next_alarm() const {
  const double deadline_s = launch_.clock.progress_deadline_s;
  if (phase_ == Phase::kJoining || phase_ == Phase::kProving) {
    double patience_s = launch_.clock.connect_timeout_s;
    for (const ProcessSpec& p : launch_.processes) {
      if (p.external) patience_s = std::max(patience_s, p.join_s);
    }
    return after(phase_began_, patience_s);
  }
  if (phase_ == Phase::kEnding) return after(phase_began_, deadline_s);
  std::optional<WallTime> alarm;
  if (epoch_.conductor->busy())
    alarm = after(epoch_.last_progress, deadline_s * (epoch_.stall_stage == 0 ? 1 : epoch_.stall_stage == 1 ? 3 : 10));
  const auto paced = pacer_.when(epoch_.conductor->next_capped());
  return paced && (!alarm || *paced < *alarm) ? paced : alarm;
}

/// What ends or moves a run counts from those alone who have joined it; everybody else gets an answer.
void Clock::on_message(const bus::ControlPlane::Message& message) {
  const std::string kind = protocol::kind_of(message.text);
  if (kind == "hello") return on_hello(message.from, message.text);
  if (kind != "done" && kind != "proven" && kind != "ready" && kind != "failed" && kind != "unusable" && kind != "bye")
    return on_request(message, kind);
  const auto rank = registry_.participant(message.from);
  if (!rank) return refuse(message.from, kind, "only for processes that have joined the run");
  if (is_lost(*rank)) return;
  try {
    on_word(*rank, kind, message.text);
  } catch (const std::exception& e) {
    fault(*rank, kExitDied, fmt::format("{} broke the protocol: {}: {}", message.from, kind, e.what()));
  }
}

void Clock::on_word(std::size_t rank, const std::string& kind, const std::string& text) {
  const std::string& name = registry_.hellos()[rank].declaration.process;
  if (kind == "done") {
    const auto done = protocol::read_done(text);
    if (!done) throw std::runtime_error(fmt::format("{} bytes are none", text.size()));
    on_done(rank, *done);
  } else if (kind == "proven") {
    on_proven(name, text);
  } else if (kind == "ready") {
    registry_.is_ready(rank);
    if (phase_ == Phase::kProving && registry_.ready()) start();
  } else if (kind == "failed") {
    on_failed(rank, protocol::read_failed(text));
  } else if (kind == "unusable") {
    on_unusable(rank, protocol::read_unusable(text));
  } else if (phase_ == Phase::kEnding) {
    left_[rank] = true;
    epoch_.accounts[rank].exit_code = protocol::read_code(text);
  } else {
    fault(rank, kExitDied, name + " left before the end of the run");
  }
}

void Clock::on_hello(const std::string& from, const std::string& text) {
  std::string refusal = "the run has started";
  if (phase_ == Phase::kJoining) {
    try {
      refusal = registry_.join(from, protocol::read_hello(text));
    } catch (const std::exception& e) {
      refusal = std::string("hello: ") + e.what();
    }
  }
  if (!refusal.empty()) {
    control_.send(from, protocol::encode_refused({refusal}));
  } else if (registry_.complete()) {
    gather();
  }
}

void Clock::gather() {
  const std::vector<std::string>& problems = registry_.check();
  if (!problems.empty()) {
    std::string all;
    for (const std::string& problem : problems) {
      log::line("clock", SimTime{0}, "refused", problem);
      all += (all.empty() ? "" : "\n") + problem;
    }
    send_to_all(protocol::encode_refused(problems));
    fail(kExitUserError, "", all);
    return;
  }
  epoch_.conductor = make_conductor(registry_.graph(), registry_.declarations(), launch_);
  epoch_.referee.emplace(epoch_.number, registry_.graph(), registry_.declarations());
  epoch_.inputs.resize(registry_.size());
  left_.assign(registry_.size(), false);
  for (const Graph::Edge& edge : registry_.graph().edges) {
    std::vector<std::uint32_t>& topics = epoch_.inputs[edge.to];
    const auto topic = static_cast<std::uint32_t>(edge.topic);
    if (std::find(topics.begin(), topics.end(), topic) == topics.end()) topics.push_back(topic);
  }
  for (const protocol::Hello& hello : registry_.hellos()) {
    epoch_.accounts.push_back({hello.declaration.process, hello.pid, 0, 0, 0, SimTime{0}});
  }
  phase_ = Phase::kProving;
  phase_began_ = steady_clock::now();
  for (std::size_t rank = 0; rank < registry_.size(); ++rank) {
    control_.send(epoch_.accounts[rank].name,
                  protocol::encode(registry_.welcome(rank), registry_.declarations()[rank]));
  }
  if (registry_.ready()) start();
}

void Clock::on_proven(const std::string& from, const std::string& text) {
  for (const std::string& token : protocol::read_tokens(text)) registry_.proven(from, token);
  if (phase_ == Phase::kProving && registry_.ready()) start();
}

void Clock::start() {
  phase_ = Phase::kRunning;
  epoch_.began = epoch_.last_progress = epoch_.health_reported = steady_clock::now();
  log::line(
      "clock", SimTime{0}, "go",
      fmt::format("epoch={} processes={} edges={} connect_s={:.4f}", epoch_.number, registry_.size(),
                  registry_.graph().edges.size(), std::chrono::duration<double>(epoch_.began - phase_began_).count()));
  hand_out();
}

/// Real time starts when everybody has run its events at sim time 0: there heads and pager get ready.
void Clock::hand_out() {
  if (epoch_.conductor->now() > SimTime{0}) pacer_.start(steady_clock::now());
  epoch_.conductor->set_cap(epoch_.ending ? kNever : pacer_.cap(steady_clock::now()));
  for (const Conductor::Grant& grant : epoch_.conductor->grants()) {
    protocol::Grant message;
    message.epoch = epoch_.number;
    message.horizon = grant.horizon;
    for (const std::uint32_t topic : epoch_.inputs[grant.participant])
      message.inputs.emplace_back(topic, epoch_.referee->published(topic));
    ++epoch_.accounts[grant.participant].grants;
    control_.send(epoch_.accounts[grant.participant].name, protocol::encode(message));
  }
  if (!epoch_.conductor->finished() || lose_doomed()) return;
  if (next_) begin_next();
  else end(0);
}

void Clock::on_done(std::size_t rank, const protocol::Done& done) {
  if (phase_ == Phase::kEnding || phase_ == Phase::kOver) return;
  if (phase_ != Phase::kRunning || !epoch_.conductor->running(rank)) throw std::runtime_error("answers no GRANT");
  const std::string& name = epoch_.accounts[rank].name;
  if (const auto breach =
          epoch_.referee->judge(rank, done, epoch_.conductor->next(rank), epoch_.conductor->granted(rank)))
    return fault(rank, breach->code, name + " " + breach->text);
  const WallTime now = steady_clock::now();
  epoch_.last_progress = now;
  epoch_.stall_stage = 0;
  Account& account = epoch_.accounts[rank];
  account.cost_ns += done.cost_ns;
  const bool was_last = epoch_.conductor->next(rank) == epoch_.conductor->now();
  const SimTime late = pacer_.lateness(epoch_.conductor->now(), now);
  note_late(rank, was_last && late > kLateAfter);
  if (account.late) {
    ++account.late_events;
    account.worst_lateness = std::max(account.worst_lateness, late);
  }
  if (done.finish) epoch_.conductor->end_at(done.next - SimTime{1} + kFinishMargin);
  epoch_.conductor->done(rank, done.next);
  if (const SimTime slipped = pacer_.slip(epoch_.conductor->now(), now); slipped > SimTime{0}) {
    ++epoch_.slips;
    epoch_.slipped += slipped;
    log::line("clock", epoch_.conductor->now(), "slip",
              fmt::format("by_s={:.3f} because_of={}", seconds(slipped), name));
    if (launch_.clock.slip_policy == ClockSettings::SlipPolicy::kFail) {
      return fail(kExitStall, name,
                  fmt::format("{} made the run {:.3f} s late; slip_policy is fail", name, seconds(slipped)));
    }
  }
  if (!lose_stopped(rank)) hand_out();
}

/// Who has ports for viewers works for them only while nobody waits for it.
void Clock::note_late(std::size_t rank, bool late) {
  Account& account = epoch_.accounts[rank];
  if (late == account.late) return;
  account.late = late;
  if (!registry_.declarations()[rank].lives.empty()) control_.send(account.name, protocol::encode_late(late));
}

/// The culprit that a participant names must be one whose messages it takes.
void Clock::on_failed(std::size_t rank, const protocol::Failed& failed) {
  const auto culprit = registry_.participant(failed.culprit);
  const bool of_another = culprit && registry_.feeds(*culprit, rank);
  if (!of_another) return fault(rank, failed.code, failed.message);
  if (phase_ == Phase::kEnding) left_[rank] = true;
  fail(failed.code, failed.culprit, failed.message);
}

void Clock::on_time(WallTime now) {
  if (stop_requested.exchange(false)) {
    next_.reset();
    if (phase_ == Phase::kRunning) end_epoch();
    else if (phase_ != Phase::kEnding) fail(kExitInterrupted, "", "stopped before time started");
  }
  switch (phase_) {
    case Phase::kJoining:
    case Phase::kProving: {
      if (now < *next_alarm()) return;
      std::string missing;
      for (const auto& name : phase_ == Phase::kJoining ? registry_.missing() : registry_.unproven()) {
        missing += (missing.empty() ? "" : ", ") + name;
      }
      return fail(kExitStall, missing,
                  (phase_ == Phase::kJoining ? "no hello from: " : "no proof of delivery on: ") + missing);
    }
    case Phase::kRunning:
      hand_out();
      if (phase_ == Phase::kRunning) watch_progress(now);
      if (phase_ == Phase::kRunning && now - epoch_.health_reported >= kHealthEvery) report_health(now);
      return;
    case Phase::kEnding:
      if (std::all_of(left_.begin(), left_.end(), [](bool bye) { return bye; }) || now >= *next_alarm()) {
        phase_ = Phase::kOver;
      }
      return;
    case Phase::kOver: return;
  }
}

void Clock::watch_progress(WallTime now) {
  if (!epoch_.conductor->busy()) {
    epoch_.last_progress = now;
    epoch_.stall_stage = 0;
    return;
  }
  const double deadline_s = launch_.clock.progress_deadline_s;
  const double silent_s = std::chrono::duration<double>(now - epoch_.last_progress).count();
  if (epoch_.stall_stage == 0 && silent_s >= deadline_s) {
    epoch_.stall_stage = 1;
    log::line("clock", epoch_.conductor->now(), "no_progress",
              fmt::format("for_s={:.2f} waiting_for={}", silent_s, names(stalled())));
  } else if (epoch_.stall_stage == 1 && silent_s >= 3 * deadline_s) {
    epoch_.stall_stage = 2;
    dump_stall();
  } else if (epoch_.stall_stage == 2 && silent_s >= 10 * deadline_s) {
    const std::vector<std::size_t> culprits = stalled();
    dump_stall();
    const std::string message = fmt::format("no progress for {:.1f} s at t={:.3f}: waiting for {}", silent_s,
                                            seconds(epoch_.conductor->now()), names(culprits));
    epoch_.last_progress = now;  // of a run that goes on without them
    epoch_.stall_stage = 0;
    bool goes_on = false;
    for (const std::size_t rank : culprits) goes_on |= lose(rank, message);
    if (!goes_on) fail(kExitStall, names(culprits), message);
  }
}

void Clock::fail(int code, const std::string& culprit, const std::string& message) {
  if (exit_code_ == 0) {  // the first fault wins
    exit_code_ = code;
    culprit_ = culprit;
    message_ = message;
    log::line("clock", epoch_.conductor ? epoch_.conductor->now() : SimTime{0}, "failed",
              fmt::format("code={} culprit={} message={}", code, culprit, message));
  }
  end(exit_code_);
}

void Clock::end(int code) {
  if (phase_ == Phase::kEnding || phase_ == Phase::kOver) return;
  epoch_.ended = phase_began_ = steady_clock::now();
  // Those who failed, stall or never joined cannot be waited for.
  phase_ = code == 0 ? Phase::kEnding : Phase::kOver;
  send_to_all(fmt::format(R"({{"kind":"end","code":{}}})", code));
  if (code == 0) {
    log::line("clock", std::min(epoch_.conductor->now(), epoch_.conductor->end()), "end",
              fmt::format("wall_s={:.3f}", std::chrono::duration<double>(epoch_.ended - epoch_.began).count()));
  }
}

void Clock::send_to_all(const std::string& text) {
  for (const protocol::Hello& hello : registry_.hellos()) {
    if (!hello.declaration.process.empty()) control_.send(hello.declaration.process, text);
  }
}

}  // namespace ensonify::clock
