#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "components/clock/pacer.h"
#include "components/clock/referee.h"
#include "components/clock/registry.h"
#include "components/runtime/bus/router.h"
#include "components/runtime/lockstep/conductor.h"
#include "components/runtime/sim_time.h"
#include "messages/clock.h"

namespace ensonify::clock {

/// Cost of each participant in wall time, and number of times the run was late by it.
struct Account {
  std::string name;
  std::int64_t pid = 0;
  std::uint64_t grants = 0;
  std::int64_t cost_ns = 0;       // wall time inside its events
  std::uint64_t late_events = 0;  // grants it finished last, more than kLateAfter behind the paced time
  SimTime worst_lateness{0};
  bool late = false;   // by its last grant, of which it hears if it has ports for viewers
  std::string doomed;  // why it is to be lost at a time to come; "": it is not
  std::string lost;    // why the run goes on without it; "": it takes part
  SimTime lost_at{0};  // before which its last event is
  int exit_code = 0;   // as it took leave
};

/// A run is late when sim time stands this far behind paced time.
inline constexpr SimTime kLateAfter = std::chrono::milliseconds(100);

/// The run as a whole.
struct Summary {
  std::string state = "connecting";  // connecting, running, paused, done, failed
  std::uint32_t epoch = 1;
  SimTime reached{0};
  std::optional<SimTime> end;
  double wall_s = 0.0;  // since time started
  std::optional<double> rate;
  std::uint64_t slips = 0;
  SimTime slipped{0};
  int exit_code = 0;
  std::string culprit;
  std::string message;
};

/// One pass of sim time from 0 on: all of a run that begins anew with a reset.
struct Epoch {
  std::uint32_t number = 1;
  std::filesystem::path out;  // folder of its results
  std::optional<Conductor> conductor;
  std::optional<Referee> referee;                  // with the conductor
  std::vector<std::vector<std::uint32_t>> inputs;  // topic ids that each participant reads
  std::vector<Account> accounts;
  bool ending = false;
  WallTime began{};  // time started
  WallTime ended{};
  WallTime last_progress{};
  int stall_stage = 0;
  WallTime health_reported{};
  SimTime health_reported_at{0};  // sim time reached then
  std::uint64_t health_count = 0;
  std::uint64_t slips = 0;
  SimTime slipped{0};
};

/// An epoch that has been asked for.
struct NextEpoch {
  Launch launch;
  protocol::Begin begin;
};

/// The conductor process: gathers everybody, checks the wiring, proves every edge, then hands out sim time until the
/// end. One thread, one socket.
class Clock {
 public:
  /// Reads a launch whole, with its scenario; throws ConfigError. For resets: the clock itself sees no world.
  using ReadLaunch = std::function<Launch(const LaunchOptions&)>;

  Clock(const Launch& launch, bus::ControlPlane& control, std::filesystem::path out_dir, ReadLaunch read);

  /// Runs to the end; returns the run's exit code.
  int run();

 private:
  enum class Phase { kJoining, kProving, kRunning, kEnding, kOver };

  std::optional<WallTime> next_alarm() const;
  void on_message(const bus::ControlPlane::Message& message);
  void on_hello(const std::string& from, const std::string& text);
  void on_word(std::size_t rank, const std::string& kind, const std::string& text);
  void on_proven(const std::string& from, const std::string& text);
  void on_done(std::size_t rank, const protocol::Done& done);
  void on_failed(std::size_t rank, const protocol::Failed& failed);
  void on_unusable(std::size_t rank, const protocol::Unusable& unusable);
  void on_request(const bus::ControlPlane::Message& message, const std::string& kind);
  // Each returns what is wrong with the request, or "".
  std::string ask_reset(const nlohmann::json& request, nlohmann::json& answer);
  std::string look_up(const nlohmann::json& request, nlohmann::json& answer) const;
  std::string steer(const std::string& kind, const nlohmann::json& request, nlohmann::json& answer);
  std::string ask_to_lose(const nlohmann::json& request, nlohmann::json& answer);
  void on_time(WallTime now);

  void end_epoch();
  void begin_next();
  void gather();
  void start();
  void hand_out();
  void watch_progress(WallTime now);
  void note_late(std::size_t rank, bool late);
  void report_health(WallTime now);
  void refuse(const std::string& to, const std::string& kind, const std::string& why);
  void fail(int code, const std::string& culprit, const std::string& message);
  void fault(std::size_t rank, int code, const std::string& message);
  bool lose(std::size_t rank, const std::string& why);
  bool lose_stopped(std::size_t rank);
  bool lose_doomed();
  bool is_lost(std::size_t rank) const { return rank < epoch_.accounts.size() && !epoch_.accounts[rank].lost.empty(); }
  void end(int code);
  void send_to_all(const std::string& text);

  char state_of(std::size_t p) const;
  std::vector<std::size_t> stalled() const;
  std::string names(const std::vector<std::size_t>& ranks) const;
  void dump_stall() const;
  Summary summary() const;
  std::string status_json() const;
  std::string registry_json() const;
  msg::ClockHealth health(WallTime now) const;
  void write_report(const std::filesystem::path& folder) const;

  const Launch first_;  // the launch as it was started
  Launch launch_;       // as the present epoch has it
  bus::ControlPlane& control_;
  ReadLaunch read_;
  Registry registry_;
  Pacer pacer_;
  Epoch epoch_;
  std::optional<NextEpoch> next_;  // begins when the present one has come to its end
  Phase phase_ = Phase::kJoining;
  WallTime phase_began_;
  std::vector<bool> left_;
  int exit_code_ = 0;
  std::string culprit_;
  std::string message_;
};

/// Set by SIGINT and SIGTERM: the run ends in order.
void request_stop();

}  // namespace ensonify::clock
