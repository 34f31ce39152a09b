#include "launch/supervisor.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "launch/idle_faults.h"

namespace ensonify::launcher {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kSettle{100};            // deaths noticed together are judged together
constexpr milliseconds kClocksWord{3000};       // it may name another process than the one that gave up first
constexpr milliseconds kSettleUserErrors{300};  // so that the mistakes in several configurations are shown at once
constexpr milliseconds kGraceAfterStop{5000};   // an orderly end after Ctrl-C
constexpr milliseconds kGraceAfterFault{400};   // everything is gone within a second of a death, but for
constexpr milliseconds kGraceToComplete{5000};  // our own processes that have files to complete
constexpr milliseconds kGraceToLeave{10000};    // after the clock's end, e.g. a recorder that writes its index
constexpr milliseconds kRespawnAfter{1000};
constexpr int kLinesOfAll = 200;  // of the clock's log, among which one is looked for

AboutRun about_run(const Launch& launch, const std::string& name) {
  using std::chrono::seconds;
  const auto now = std::chrono::duration_cast<seconds>(std::chrono::system_clock::now().time_since_epoch());
  std::error_code error;  // a path that cannot be made absolute stays as it is
  const auto whole = [&](const std::string& path) {
    const std::string absolute = std::filesystem::absolute(path, error).lexically_normal().string();
    return error ? path : absolute;
  };
  return {name, whole(launch.file), whole(launch.options.out), now.count(), ::getpid()};
}

}  // namespace

Supervisor::Supervisor(const Launch& launch, const World& world, const std::string& program_folder, bool quiet,
                       const std::string& name, std::set<std::string> hosted)
    : launch_(launch),
      run_dir_(about_run(launch, name)),
      guard_(run_dir_.path()),
      places_{program_folder, run_dir_.path(), launch.options.out},
      quiet_(quiet),
      hosted_(std::move(hosted)),
      progress_(quiet, expected_duration_s(launch, world)) {}

RunReport Supervisor::run() {
  began_ = steady_clock::now();
  make_folder(places_.out + "/log");
  remove_reports(places_.out);
  members_.push_back({.name = "clock"});
  for (const auto& process : launch_.processes) {
    members_.push_back({.name = process.name, .spec = &process});
  }
  // All programs are known before the first starts.
  for (const auto& process : launch_.processes) {
    if (!process.external && !hosted_.contains(process.name)) {
      process_command(launch_, process, places_, "");
    }
  }
  try {
    start_clock();
    if (!clock_endpoint_.empty()) {
      start_members();
    }
    supervise();
  } catch (...) {
    send_all(SIGKILL);
    throw;
  }
  judge_exits();
  progress_.finish();
  return report();
}

void Supervisor::start(Member& member, const Command& command) {
  member.child.emplace(command);
  member.state = "STARTING";
  guard_.watch(member.child->pid());
}

/// Before the clock starts, which reads them.
void Supervisor::make_keys() {
  const ClockSettings& clock = launch_.clock;
  if (clock.transport != ClockSettings::Transport::kTcp || !clock.keys) return;
  std::vector<std::string> allowed = clock.allow;
  allowed.insert(allowed.end(), {"127.0.0.0/8", clock.address});
  keys_ = bus::Keys::make(allowed);
  keys_->write(run_dir_.file(bus::kKeysFile));
}

void Supervisor::start_clock() {
  make_keys();
  FileWatch watch(places_.run_dir);
  start(clock(), clock_command(launch_, places_, hosted_));
  const std::string file = run_dir_.file("clock.endpoint");
  const auto until = began_ + std::chrono::duration_cast<steady_clock::duration>(
                                  std::chrono::duration<double>(launch_.clock.connect_timeout_s));
  while (clock().child->running() && interrupts_ == 0) {
    if (std::ifstream stream(file); stream) {
      std::getline(stream, clock_endpoint_);
      query_ = std::make_unique<bus::ClockQuery>(clock_endpoint_, keys_);
      say_where();
      last_answer_ = steady_clock::now();
      return;
    }
    const auto now = steady_clock::now();
    if (now >= until) {
      noticed_.push_back(
          {kExitStall, "clock", fmt::format("did not start within {} s", launch_.clock.connect_timeout_s)});
      judge_at_ = now;
      return;
    }
    watch.wait(signals_, std::chrono::ceil<milliseconds>(until - now));
    take_signals();
  }
}

/// For whoever asks the run's clock, watches its topics or starts external processes.
void Supervisor::say_where() const {
  if (quiet_) return;
  const std::string name = LiveRun{run_dir_.path(), clock_endpoint_, read_about(run_dir_.path())}.id();
  fmt::print(stderr, "ensonify run: tools reach this run by --run {0}: ensonify topic list --run {0}\n", name);
  const bool awaits = std::any_of(launch_.processes.begin(), launch_.processes.end(),
                                  [](const ProcessSpec& process) { return process.external; });
  if (!awaits) return;
  fmt::print(stderr, "ensonify run: external processes take part at {}{}\n", clock_endpoint_,
             keys_ ? " with the keys in " + run_dir_.file(bus::kKeysFile) : "");
}

void Supervisor::start_members() {
  for (auto& member : members_) {
    if (member.spec != nullptr && !member.spec->external && !hosted_.contains(member.name)) {
      start(member, process_command(launch_, *member.spec, places_, clock_endpoint_));
    }
  }
}

void Supervisor::supervise() {
  while (anything_runs() || !noticed_.empty()) {
    signals_.wait(noticed_.empty() ? milliseconds(50) : milliseconds(10));
    take_signals();
    on_time(steady_clock::now());
  }
}

void Supervisor::take_signals() {
  const auto arrived = signals_.take();
  while (const auto reaped = reap()) {
    on_ended(*reaped);
  }
  if (arrived.interrupts == 0) {
    return;
  }
  const auto now = steady_clock::now();
  interrupts_ += arrived.interrupts;
  verdict_.interrupted();
  if (interrupts_ == 1 && query_ && clock().child->running()) {
    progress_.finish();
    fmt::print(stderr, "ensonify run: stopping in order; press Ctrl-C again to stop at once\n");
    query_->ask(R"({"kind":"stop"})", kAnswerPatience);
    begin(Ending::kAsked, now, kGraceAfterStop);
  } else {
    begin(Ending::kTerminated, now, kGraceAfterFault);
  }
}

void Supervisor::on_ended(const Reaped& reaped) {
  const auto found = std::find_if(members_.begin(), members_.end(), [&](const Member& m) {
    return m.child && m.child->running() && m.child->pid() == reaped.pid;
  });
  if (found == members_.end()) {
    return;  // the guard
  }
  Member& member = *found;
  const auto now = steady_clock::now();
  member.child->ended(reaped.wait_status, reaped.max_rss_kib, reaped.cpu_s);
  guard_.forget(reaped.pid);
  if (member.spec == nullptr) {
    on_clock_ended(member);
    return;
  }
  const bool native = member.spec->argv.empty();
  auto fault = fault_of(member.name, native, *member.child->ending());
  const bool had_joined = member.state != "STARTING";
  member.state = member.loss ? "LOST" : !fault ? "DONE" : by_us() ? "STOPPED" : "FAILED";
  if (!fault) {
    member.left_at = now;
  } else if (fault->code == kExitAssertionFailed) {
    if (!ended_as_expected(member.name)) {
      member.fault = fault;
      if (member.name != "expect") member.fault->message += last_words(member);  // which says it in expect.json
      verdict_.assertion_failed(member.name, member.fault->message);
    }
  } else if (member.spec->observer) {
    if (member.spec->respawn && ending_ == Ending::kNo && clock().child->running()) {
      member.respawn_at = now + kRespawnAfter;
    }
  } else if (!by_us()) {
    if (member.child->ending()->signal == 0 && fault->code != kExitUserError) fault->message += last_words(member);
    if (member.spec->may_be_lost && lose(member, fault->message)) return;
    member.fault = fault;
    noticed_.push_back(*fault);
    const bool clock_knows =
        had_joined && fault->code != kExitUserError && member.child->ending()->signal == 0 && clock().child->running();
    judge_at_ = now + (fault->code == kExitUserError ? kSettleUserErrors : clock_knows ? kClocksWord : kSettle);
  }
}

/// The clock knows more than its exit code: it wrote down who is to blame.
void Supervisor::on_clock_ended(Member& member) {
  auto fault = fault_of("clock", true, *member.child->ending());
  const auto now = steady_clock::now();
  member.state = !fault ? "DONE" : by_us() ? "STOPPED" : "FAILED";
  const auto reported = read_clock_report(places_.out);
  on_hosted_ended(reported);
  if (reported) {
    sim_s_ = reported->sim_s;
    note_losses(reported->losses, now);
    if (fault && reported->exit_code == fault->code) {
      fault->culprit = reported->culprit.empty() ? fault->culprit : reported->culprit;
      fault->message = reported->message.empty() ? fault->message : reported->message;
    }
  }
  if (fault && !by_us() && fault->code != kExitInterrupted) {
    fault->by_clock = true;
    member.fault = fault;
    noticed_.push_back(*fault);
    judge_at_ = now + kSettle;
  } else if (ending_ == Ending::kNo || ending_ == Ending::kAsked) {
    begin(Ending::kAsked, now, kGraceToLeave);
    for (auto& other : members_) {  // observers have nothing left to see
      if (other.child && other.spec != nullptr && other.spec->observer) {
        other.child->send(SIGTERM);
      }
    }
  }
}

/// The last line that it logged, after a colon; of one in the clock's program, among those of others.
std::string Supervisor::last_words(const Member& member) const {
  const bool hosted = hosted_.contains(member.name);
  std::string words = tail(places_.out + "/log/" + (hosted ? "clock" : member.name) + ".log", hosted ? kLinesOfAll : 1);
  if (hosted) {
    const std::size_t own = words.rfind(" " + member.name + " ");
    if (own == std::string::npos) return "";
    words = words.substr(words.rfind('\n', own) + 1);
    words = words.substr(0, words.find('\n'));
  }
  return words.empty() ? "" : ": " + words;
}

/// With the clock, in whose program they were.
void Supervisor::on_hosted_ended(const std::optional<ClockReport>& reported) {
  const bool well = clock().state == "DONE";
  for (Member& member : members_) {
    if (!hosted_.contains(member.name)) continue;
    const bool to_blame = reported && reported->culprit == member.name;
    const bool took_leave = well && reported && reported->exit_codes.contains(member.name);
    if (to_blame) member.fault = Fault{reported->exit_code, member.name, reported->message};
    if (took_leave) {
      member.fault = fault_of(member.name, true, {reported->exit_codes.at(member.name), 0});
      member.fault->message += last_words(member);
      if (member.fault->code == kExitAssertionFailed) verdict_.assertion_failed(member.name, member.fault->message);
      else noticed_.push_back(*member.fault);
    }
    member.state = member.fault ? "FAILED" : well ? "DONE" : "STOPPED";
  }
}

/// It writes down who is to blame before it takes leave of the others, for which a loaded machine may need seconds.
void Supervisor::ask_for_the_clocks_word(WallTime now) {
  if (noticed_.empty() || !clock().child || !clock().child->running()) {
    return;
  }
  const auto reported = read_clock_report(places_.out);
  if (reported && reported->exit_code != kExitOk && !reported->culprit.empty()) {
    noticed_.push_back({reported->exit_code, reported->culprit, reported->message, true});
    judge_at_ = std::min(judge_at_, now);
  }
}

void Supervisor::judge() {
  const Fault fault = most_significant(noticed_);
  noticed_.clear();
  if (!ended_as_expected(fault.culprit)) {
    verdict_.fault(fault);
    return;
  }
  cut_short_ = true;
  for (auto& member : members_) {  // also the clock's, which names the same culprit
    if (member.fault && member.fault->culprit == fault.culprit) {
      member.fault.reset();
    }
  }
}

/// Nothing while it runs, or when it was never started.
std::optional<launcher::Ending> Supervisor::ending_of(const std::string& process) const {
  for (const auto& member : members_) {
    if (member.name == process && member.child) {
      return member.child->ending();
    }
  }
  return std::nullopt;
}

/// The launch file expects this process to fail, and it failed that way. A process expected to end with 0 may still not
/// leave before the others.
bool Supervisor::ended_as_expected(const std::string& process) const {
  const auto ending = ending_of(process);
  return ending && std::any_of(launch_.exits.begin(), launch_.exits.end(), [&](const ExitExpectation& exit) {
           return exit.process == process && exit.signal == ending->signal && exit.code == ending->exit_code &&
                  (exit.signal != 0 || exit.code != 0);
         });
}

void Supervisor::judge_exits() {
  for (const auto& exit : launch_.exits) {
    const auto ending = ending_of(exit.process);
    const bool ok = ending && ending->signal == exit.signal && ending->exit_code == exit.code;
    exits_.push_back({exit.name, ok, sim_s_, ending ? "it ended with " + text_of(*ending) : "it was not started"});
  }
  if (cut_short_ && launch_.processes.back().component == "expect") {
    exits_.push_back(
        {"other expectations", false, sim_s_, "were not judged: the run was cut short by an expected end"});
  }
  if (!cut_short_ && verdict_.code() <= kExitAssertionFailed) {
    for (Expectation& idle : idle_faults(launch_, places_.out, sim_s_)) exits_.push_back(std::move(idle));
  }
  if (std::any_of(exits_.begin(), exits_.end(), [](const Expectation& e) { return !e.ok; })) {
    verdict_.assertion_failed("expect", "assertions failed");
  }
}

void Supervisor::begin(Ending ending, WallTime now, milliseconds grace) {
  if (ending < ending_) {
    return;
  }
  ending_ = ending;
  ending_until_ = now + grace;
  if (ending == Ending::kTerminated) {
    send_all(SIGTERM);
    send_all(SIGCONT);
  } else if (ending == Ending::kForeignKilled) {
    for (const auto& member : members_) {
      const bool ours = member.spec != nullptr && member.spec->argv.empty();
      if (member.child && !ours) {
        member.child->send(SIGKILL);
      }
    }
  } else if (ending == Ending::kKilled) {
    send_all(SIGKILL);
  }
}

void Supervisor::on_time(WallTime now) {
  ask_for_the_clocks_word(now);
  if (!noticed_.empty() && now >= judge_at_) {
    judge();
    begin(Ending::kTerminated, now, kGraceAfterFault);
  }
  if (ending_ != Ending::kNo && now >= ending_until_ && anything_runs()) {
    if (ending_ == Ending::kAsked) {
      for (const auto& member : members_) {
        const bool stays = !clock().child->running() && member.child && member.child->running();
        if (stays && !member.spec->observer && !member.spec->may_be_lost) {
          noticed_.push_back({kExitStall, member.name, "did not leave after the end of the run"});
        }
      }
      if (!noticed_.empty()) {
        judge();
      }
      begin(Ending::kTerminated, now, kGraceAfterFault);
    } else if (ending_ == Ending::kTerminated) {
      begin(Ending::kForeignKilled, now, kGraceToComplete);
    } else {
      begin(Ending::kKilled, now, kGraceAfterFault);
    }
  }
  if (ending_ == Ending::kNo && query_) {
    ask_clock(now);
    check_leavers(now);
    respawn(now);
    watch_memory(now);
  }
  kill_lost(now);
  progress_.show(sim_s_, elapsed_s(began_, now), clock_state_);
}

void Supervisor::send_all(int signal) {
  for (const auto& member : members_) {
    if (member.child) {
      member.child->send(signal);
    }
  }
}

bool Supervisor::anything_runs() const {
  return std::any_of(members_.begin(), members_.end(), [](const Member& m) { return m.child && m.child->running(); });
}

RunReport Supervisor::report() const {
  RunReport report;
  report.code = verdict_.code();
  report.cause = verdict_.cause();
  report.sim_s = sim_s_;
  report.wall_s = elapsed_s(began_, steady_clock::now());
  for (const auto& member : members_) {
    ProcessReport process;
    process.name = member.name;
    process.state = member.state;
    process.external = member.spec != nullptr && member.spec->external;
    process.hosted = hosted_.contains(member.name);
    process.fault = member.fault;
    process.loss = member.loss;
    if (process.hosted && (member.state == "DONE" || member.state == "FAILED"))
      process.ending = launcher::Ending{member.fault ? member.fault->code : kExitOk, 0};
    if (member.child) {
      process.ending = member.child->ending();
      process.max_rss_kib = member.child->max_rss_kib();
      process.cpu_s = member.child->cpu_s();
    }
    report.processes.push_back(std::move(process));
  }
  report.expectations = read_expectations(places_.out + "/expect.json");
  report.expectations.insert(report.expectations.end(), exits_.begin(), exits_.end());
  return report;
}

}  // namespace ensonify::launcher
