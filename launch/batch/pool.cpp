#include "launch/batch/pool.h"

#include <csignal>
#include <deque>
#include <fstream>
#include <iterator>
#include <memory>
#include <utility>

#include "launch/child.h"
#include "launch/run_dir.h"

namespace ensonify::batch {
namespace {

using Clock = std::chrono::steady_clock;

/// What a run has to itself after it was asked to end: its own deadlines are shorter.
constexpr std::chrono::seconds kGrace{30};

struct Running {
  const Job* job;
  std::unique_ptr<launcher::Child> child;
  Clock::time_point began, until;
  bool timed_out = false;
};

launcher::Command command_of(const Job& job, const Folder& folder, const PoolSettings& settings) {
  launcher::Command command;
  command.argv = {settings.program_folder + "/ensonify-run",
                  job.options.file,
                  "--json",
                  "--quiet",
                  "--out",
                  folder.run_of(job),
                  "--junit",
                  folder.run_of(job) + "/junit.xml"};
  for (const std::string& word : job.options.args) command.argv.insert(command.argv.end(), {"--arg", word});
  for (const std::string& word : job.options.sets) command.argv.insert(command.argv.end(), {"--set", word});
  command.argv.insert(command.argv.end(), settings.run_words.begin(), settings.run_words.end());
  command.log_file = folder.run_of(job) + "/run.out";
  command.error_file = folder.run_of(job) + "/run.err";
  return command;
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Pool {
 public:
  Pool(const Folder& folder, const PoolSettings& settings, const std::function<bool(const Job&)>& ended)
      : folder_(folder), settings_(settings), ended_(ended) {}

  bool run(std::deque<const Job*> waiting) {
    while ((more_ && !waiting.empty()) || !running_.empty()) {
      while (!interrupted_ && more_ && !waiting.empty() && running_.size() < settings_.at_once) {
        start(*waiting.front());
        waiting.pop_front();
      }
      if (running_.empty()) break;
      signals_.wait(std::chrono::milliseconds(200));
      if (const auto arrived = signals_.take(); arrived.interrupts > 0) end_all();
      reap_all();
      check_time();
    }
    return !interrupted_;
  }

 private:
  void start(const Job& job) {
    {  // a run of a batch that was killed may still be ending there
      const launcher::OutFolder ours(folder_.run_of(job), kGrace);
    }
    const Clock::time_point now = Clock::now();
    running_.push_back(
        {&job, std::make_unique<launcher::Child>(command_of(job, folder_, settings_)), now, now + settings_.longest});
  }

  void end_all() {
    for (Running& one : running_) one.child->send(interrupted_ ? SIGKILL : SIGINT);
    interrupted_ = true;
  }

  void reap_all() {
    while (const auto reaped = launcher::reap()) {
      for (std::size_t i = 0; i < running_.size(); ++i) {
        if (running_[i].child->pid() != reaped->pid) continue;
        running_[i].child->ended(reaped->wait_status, reaped->max_rss_kib, reaped->cpu_s);
        finish(running_[i]);
        running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
        break;
      }
    }
  }

  /// A run that was interrupted is not done: it runs again next time.
  void finish(const Running& one) {
    const launcher::Ending ending = *one.child->ending();
    if (interrupted_) return;
    const int code = one.timed_out ? Result::kTimedOut : ending.signal != 0 ? int{kExitDied} : ending.exit_code;
    const double wall_s = std::chrono::duration<double>(Clock::now() - one.began).count();
    folder_.done(*one.job, code, text_of(folder_.run_of(*one.job) + "/run.out"), wall_s);
    more_ = ended_(*one.job) && more_;
  }

  void check_time() {
    const Clock::time_point now = Clock::now();
    for (Running& one : running_) {
      if (now < one.until) continue;
      one.child->send(one.timed_out ? SIGKILL : SIGINT);
      one.timed_out = true;
      one.until = now + kGrace;
    }
  }

  const Folder& folder_;
  const PoolSettings& settings_;
  const std::function<bool(const Job&)>& ended_;
  launcher::Signals signals_;  // before anything is forked
  std::vector<Running> running_;
  bool interrupted_ = false, more_ = true;
};

}  // namespace

bool run_jobs(std::span<const Job> jobs, const Folder& folder, const PoolSettings& settings,
              const std::function<bool(const Job&)>& ended) {
  std::deque<const Job*> waiting;
  for (const Job& job : jobs) {
    if (!folder.result_of(job)) waiting.push_back(&job);
  }
  Pool pool(folder, settings, ended);
  return pool.run(std::move(waiting));
}

}  // namespace ensonify::batch
