#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "components/runtime/bus/router.h"
#include "launch/child.h"
#include "launch/commands.h"
#include "launch/file/launch_file.h"
#include "launch/report.h"
#include "launch/run_dir.h"

namespace ensonify::launcher {

/// Starts the processes of a launch, watches over them and ends them. One thread: it waits for signals (a child has
/// ended, Ctrl-C) and five times a second asks the clock how far it is.
class Supervisor {
 public:
  /// `name` is what tools may call the run by, or ""; `hosted` are the processes that live in the clock's program.
  Supervisor(const Launch& launch, const World& world, const std::string& program_folder, bool quiet,
             const std::string& name = "", std::set<std::string> hosted = {});

  /// Runs the launch to its end; nothing that it started is left. Throws UserError for what cannot be started.
  RunReport run();

 private:
  using WallTime = std::chrono::steady_clock::time_point;

  /// A process of the launch, or the clock (spec is nullptr).
  struct Member {
    std::string name;
    const ProcessSpec* spec = nullptr;
    std::optional<Child> child;
    std::string state = "STARTING";
    std::optional<Fault> fault;
    std::optional<WallTime> left_at;  // ended without a fault
    std::optional<WallTime> respawn_at;
    std::optional<Loss> loss;         // the run goes on without it
    std::optional<WallTime> kill_at;  // one that is lost and still there
  };

  /// Ending of the run; each step has a deadline after which the next begins.
  enum class Ending { kNo, kAsked, kTerminated, kForeignKilled, kKilled };

  static constexpr std::chrono::milliseconds kAnswerPatience{50};
  static double elapsed_s(WallTime from, WallTime to) { return std::chrono::duration<double>(to - from).count(); }

  void make_keys();
  void start_clock();
  void say_where() const;
  void start_members();
  void start(Member& member, const Command& command);
  void supervise();
  bool wait(std::chrono::milliseconds patience);
  void take_signals();
  void on_ended(const Reaped& reaped);
  void on_clock_ended(Member& clock);
  std::string last_words(const Member& member) const;
  void on_hosted_ended(const std::optional<ClockReport>& reported);
  void ask_for_the_clocks_word(WallTime now);
  void judge();
  std::optional<launcher::Ending> ending_of(const std::string& process) const;
  bool ended_as_expected(const std::string& process) const;
  void judge_exits();
  void on_time(WallTime now);
  void ask_clock(WallTime now);
  void read_status(const std::string& text);
  void check_leavers(WallTime now);
  void respawn(WallTime now);
  bool lose(Member& member, const std::string& why);
  void note_loss(Member& member, const Loss& loss);
  void note_losses(const std::vector<Loss>& losses, WallTime now);
  void kill_lost(WallTime now);
  void watch_memory(WallTime now);
  void begin(Ending ending, WallTime now, std::chrono::milliseconds grace);
  void send_all(int signal);
  bool by_us() const { return ending_ >= Ending::kTerminated; }
  bool anything_runs() const;
  RunReport report() const;

  Member& clock() { return members_.front(); }
  const Member& clock() const { return members_.front(); }

  const Launch& launch_;
  Signals signals_;  // before anything is forked or threaded
  RunDir run_dir_;
  Guard guard_;
  RunPlaces places_;
  bool quiet_;
  std::set<std::string> hosted_;
  std::optional<bus::Keys> keys_;
  Progress progress_;
  std::vector<Member> members_;  // the clock first
  std::unique_ptr<bus::ClockQuery> query_;
  std::string clock_endpoint_;
  Verdict verdict_;
  std::vector<Expectation> exits_;  // of the launch file's `exit:` entries
  bool cut_short_ = false;          // by a death that was expected
  std::vector<Fault> noticed_;      // faults that wait for their judgement
  WallTime judge_at_{};
  Ending ending_ = Ending::kNo;
  WallTime ending_until_{};
  int interrupts_ = 0;
  WallTime began_{};
  WallTime last_asked_{};
  WallTime last_answer_{};
  WallTime memory_watched_{};
  double sim_s_ = 0.0;
  std::string clock_state_ = "STARTING";
};

}  // namespace ensonify::launcher
