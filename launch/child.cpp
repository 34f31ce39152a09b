#include "launch/child.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/inotify.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>

#include "components/errors/exit_error.h"

namespace ensonify::launcher {

namespace {

sigset_t watched() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int signal : {SIGCHLD, SIGINT, SIGTERM}) {
    ::sigaddset(&set, signal);
  }
  return set;
}

[[noreturn]] void fail(const std::string& what) { throw ExitError(kExitDied, what + ": " + std::strerror(errno)); }

std::vector<std::string> environment(const std::map<std::string, std::string>& added) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (added.count(text.substr(0, text.find('='))) == 0) {
      all.push_back(text);
    }
  }
  for (const auto& [name, value] : added) {
    all.push_back(name + "=" + value);
  }
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (auto& text : texts) {
    all.push_back(text.data());
  }
  all.push_back(nullptr);
  return all;
}

/// What the new process does before it becomes the program. Other threads of ours may have held locks when we forked,
/// so only system calls are allowed here. Gives back errno when a step failed.
int become(const std::vector<char*>& argv, const std::vector<char*>& env, const cpu_set_t* cpus, int log_fd,
           int error_fd, int keep_fd, pid_t parent) {
  ::setpgid(0, 0);
  if (::prctl(PR_SET_PDEATHSIG, SIGTERM) != 0) {
    return errno;
  }
  if (::getppid() != parent) {  // it died before the line above
    return ESRCH;
  }
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  if (cpus != nullptr && ::sched_setaffinity(0, sizeof *cpus, cpus) != 0) {
    return errno;
  }
  // A process in the background must not read the terminal.
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing < 0 || ::dup2(nothing, STDIN_FILENO) < 0) {
    return errno;
  }
  if (nothing != STDIN_FILENO) {
    ::close(nothing);
  }
  if (log_fd >= 0 && (::dup2(log_fd, STDOUT_FILENO) < 0 || ::dup2(error_fd, STDERR_FILENO) < 0)) {
    return errno;
  }
  if (keep_fd >= 0) {
    ::fcntl(keep_fd, F_SETFD, 0);
  }
  ::execve(argv[0], argv.data(), env.data());
  return errno;
}

/// A new file for a child to write, or -1 for no name.
int open_log(const std::string& file) {
  if (file.empty()) {
    return -1;
  }
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) {
    throw UserError(file + ": cannot be written: " + std::strerror(errno));
  }
  return fd;
}

/// The read end gives errno of a child that could not become its program; exec closes it silently.
int wait_for_exec(int read_fd) {
  int error = 0;
  ssize_t got = 0;
  do {
    got = ::read(read_fd, &error, sizeof error);
  } while (got < 0 && errno == EINTR);
  return got == static_cast<ssize_t>(sizeof error) ? error : 0;
}

}  // namespace

Signals::Signals() {
  const sigset_t set = watched();
  ::signal(SIGPIPE, SIG_IGN);
  if (::sigprocmask(SIG_BLOCK, &set, nullptr) != 0 || (fd_ = ::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK)) < 0) {
    fail("signals cannot be watched");
  }
}

Signals::~Signals() {
  take();
  const sigset_t set = watched();
  ::close(fd_);
  ::sigprocmask(SIG_UNBLOCK, &set, nullptr);
}

Signals::Arrived Signals::take() {
  Arrived arrived;
  signalfd_siginfo info{};
  while (::read(fd_, &info, sizeof info) == static_cast<ssize_t>(sizeof info)) {
    if (info.ssi_signo == SIGCHLD) {
      arrived.child = true;
    } else {
      ++arrived.interrupts;
    }
  }
  return arrived;
}

bool Signals::wait(std::chrono::milliseconds patience) const {
  pollfd item{fd_, POLLIN, 0};
  return ::poll(&item, 1, static_cast<int>(patience.count())) > 0;
}

FileWatch::FileWatch(const std::string& folder) {
  fd_ = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  if (fd_ < 0 || ::inotify_add_watch(fd_, folder.c_str(), IN_MOVED_TO | IN_CLOSE_WRITE) < 0) {
    fail(folder + ": cannot be watched");
  }
}

FileWatch::~FileWatch() { ::close(fd_); }

void FileWatch::wait(const Signals& signals, std::chrono::milliseconds patience) {
  pollfd items[] = {{fd_, POLLIN, 0}, {signals.fd(), POLLIN, 0}};
  ::poll(items, 2, static_cast<int>(patience.count()));
  char events[4096];
  while (::read(fd_, events, sizeof events) > 0) {
  }
}

void Verdict::fault(Fault fault) {
  if (!first_) {
    first_ = std::move(fault);
  }
}

void Verdict::assertion_failed(const std::string& process, const std::string& message) {
  if (!failed_) {
    failed_ = Fault{kExitAssertionFailed, process, message};
  }
}

void Verdict::interrupted() { fault({kExitInterrupted, "", "interrupted"}); }

std::optional<Fault> Verdict::cause() const { return first_ ? first_ : failed_; }

int Verdict::code() const { return cause() ? cause()->code : kExitOk; }

std::string text_of(const Ending& ending) {
  return ending.signal != 0 ? "signal " + std::to_string(ending.signal) + " (" + ::strsignal(ending.signal) + ")"
                            : "exit code " + std::to_string(ending.exit_code);
}

std::optional<Fault> fault_of(const std::string& process, bool native, const Ending& ending) {
  if (ending.signal != 0) {
    return Fault{kExitDied, process, "was killed by " + text_of(ending)};
  }
  const int code = ending.exit_code;
  if (code == kExitOk) {
    return std::nullopt;
  }
  const bool reported = native ? code <= kExitDiffer : code == kExitUserError || code == kExitDataLost;
  const char* const kMeanings[] = {"",
                                   process == "expect" ? "assertions failed" : "did not reach its goal",
                                   "refused its files or arguments",
                                   "died",
                                   "stalled",
                                   "lost data",
                                   "found runs that differ"};
  const std::string meaning = reported ? kMeanings[code] : "died";
  return Fault{reported ? code : int{kExitDied}, process, meaning + " (" + text_of(ending) + ")"};
}

Fault most_significant(const std::vector<Fault>& faults) {
  const auto weight = [](const Fault& fault) {
    return fault.message.starts_with("was killed by signal") ? 0 : fault.by_clock || fault.culprit == "clock" ? 1 : 2;
  };
  return *std::min_element(faults.begin(), faults.end(),
                           [&](const Fault& a, const Fault& b) { return weight(a) < weight(b); });
}

std::string find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    return ::access(name.c_str(), X_OK) == 0 ? name : "";
  }
  const char* path = std::getenv("PATH");
  std::string rest = path != nullptr ? path : "/usr/bin:/bin";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const std::string candidate = rest.substr(0, colon) + "/" + name;
    if (::access(candidate.c_str(), X_OK) == 0) {
      return candidate;
    }
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return "";
}

Child::Child(const Command& command) {
  std::vector<std::string> argv_texts = command.argv;
  std::vector<std::string> env_texts = environment(command.env);
  const std::vector<char*> argv = pointers(argv_texts);
  const std::vector<char*> env = pointers(env_texts);
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  for (const int cpu : command.cpus) {
    CPU_SET(static_cast<std::size_t>(cpu), &cpus);
  }
  const int log_fd = command.output_to_error ? ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0) : open_log(command.log_file);
  const int error_fd = command.error_file.empty() ? log_fd : open_log(command.error_file);
  int pipe_fds[2];
  if (::pipe2(pipe_fds, O_CLOEXEC) != 0) {
    throw UserError(command.argv[0] + ": cannot be started: " + std::strerror(errno));
  }
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) {
    const int error =
        become(argv, env, command.cpus.empty() ? nullptr : &cpus, log_fd, error_fd, command.keep_fd, parent);
    [[maybe_unused]] const ssize_t written = ::write(pipe_fds[1], &error, sizeof error);
    ::_exit(kExitDied);
  }
  const int fork_error = errno;
  ::close(pipe_fds[1]);
  if (error_fd >= 0 && error_fd != log_fd) {
    ::close(error_fd);
  }
  if (log_fd >= 0) {
    ::close(log_fd);
  }
  const int error = pid_ < 0 ? fork_error : wait_for_exec(pipe_fds[0]);
  ::close(pipe_fds[0]);
  if (error != 0) {
    if (pid_ > 0) {
      ::waitpid(pid_, nullptr, 0);
    }
    throw UserError(command.argv[0] + ": cannot be started: " + std::strerror(error));
  }
  ::setpgid(pid_, pid_);  // the child does it too; whoever comes first
}

void Child::send(int signal) const {
  if (running()) {
    ::kill(-pid_, signal);
  }
}

void Child::ended(int wait_status, long max_rss_kib, double cpu_s) {
  ending_ = WIFSIGNALED(wait_status) ? Ending{0, WTERMSIG(wait_status)} : Ending{WEXITSTATUS(wait_status), 0};
  max_rss_kib_ = max_rss_kib;
  cpu_s_ = cpu_s;
}

std::optional<Reaped> reap() {
  siginfo_t info{};
  if (::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == 0) {
    return std::nullopt;
  }
  // Whatever it has started and left in its group goes with it, while its number cannot be anybody else's yet.
  ::kill(-info.si_pid, SIGKILL);
  Reaped reaped;
  rusage usage{};
  reaped.pid = ::wait4(info.si_pid, &reaped.wait_status, 0, &usage);
  const auto in_s = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  reaped.max_rss_kib = usage.ru_maxrss;
  reaped.cpu_s = in_s(usage.ru_utime) + in_s(usage.ru_stime);
  return reaped;
}

void reap_into(Child& child) {
  while (const auto reaped = reap()) {
    if (reaped->pid == child.pid()) {
      child.ended(reaped->wait_status, reaped->max_rss_kib, reaped->cpu_s);
    }
  }
}

std::optional<Ending> end_within(Child& child, Signals& signals, std::chrono::milliseconds patience) {
  using std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kEver{-1};
  const auto until = steady_clock::now() + patience;
  bool killed = false;
  while (child.running()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - steady_clock::now());
    const bool ready = signals.wait(killed ? kEver : std::max(left, std::chrono::milliseconds(0)));
    // Between the wait and the reaping, nowhere else: a child whose signal is taken is reaped now, not waited for.
    const bool interrupted = signals.take().interrupts > 0;
    reap_into(child);
    if (!ready || interrupted) {
      child.send(SIGKILL);
      killed = true;
    }
  }
  return killed ? std::nullopt : child.ending();
}

std::string tail(const std::string& file, int lines) {
  std::ifstream stream(file);
  std::deque<std::string> last;
  for (std::string line; std::getline(stream, line);) {
    last.push_back(line);
    if (last.size() > static_cast<std::size_t>(lines)) {
      last.pop_front();
    }
  }
  std::string text;
  for (const auto& line : last) {
    text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

}  // namespace ensonify::launcher
