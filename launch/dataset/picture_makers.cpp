#include "launch/dataset/picture_makers.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>

#include "components/errors/exit_error.h"
#include "launch/child.h"

namespace ensonify::dataset {
namespace {

constexpr std::size_t kMostWaiting = 4;  // scenes of one maker

}  // namespace

/// One process. Scenes go to it by a socket, a line each; for each comes a line back: "ok", or a code and what is
/// wrong.
class PictureMakers::Maker {
 public:
  Maker(const std::string& folder, std::size_t number, bool keep)
      : log_(fmt::format("{}/pictures_{}.log", folder, number)) {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      throw ExitError(kExitDied, "pictures: no socket to who makes them");
    fd_ = ends[0];
    launcher::Command command;
    command.argv = {
        launcher::find_program("python3"), "-m", "ensonify.dataset", "make", folder, std::to_string(ends[1])};
    if (keep) command.argv.emplace_back("--keep");
    command.keep_fd = ends[1];
    command.log_file = log_;
    try {
      child_ = std::make_unique<launcher::Child>(command);
    } catch (...) {
      ::close(ends[0]), ::close(ends[1]);
      throw;
    }
    ::close(ends[1]);
  }
  ~Maker() { ::close(fd_); }
  Maker(const Maker&) = delete;
  Maker& operator=(const Maker&) = delete;

  void make(const std::string& scene) {
    while (waiting_ >= kMostWaiting) take_answer();
    const std::string line = scene + "\n";
    for (std::size_t sent = 0; sent < line.size();) {
      const ssize_t more = ::send(fd_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
      if (more < 0 && errno != EINTR) gone();
      if (more > 0) sent += static_cast<std::size_t>(more);
    }
    ++waiting_;
  }

  void finish() {
    while (waiting_ > 0) take_answer();
  }

 private:
  void take_answer() {
    std::size_t end = 0;
    while ((end = received_.find('\n')) == std::string::npos) {
      std::array<char, 4096> more{};
      const ssize_t got = ::read(fd_, more.data(), more.size());
      if (got == 0 || (got < 0 && errno != EINTR)) gone();
      if (got > 0) received_.append(more.data(), static_cast<std::size_t>(got));
    }
    const std::string answer = received_.substr(0, end);
    received_.erase(0, end + 1);
    --waiting_;
    if (answer == "ok") return;
    char* text = nullptr;
    const auto code = static_cast<ExitCode>(std::strtol(answer.c_str(), &text, 10));
    throw ExitError(code, text);
  }

  [[noreturn]] void gone() const {
    throw ExitError(kExitDied, "pictures: who makes them has ended: " + launcher::tail(log_, 5));
  }

  std::string log_;
  std::unique_ptr<launcher::Child> child_;
  int fd_ = -1;
  std::size_t waiting_ = 0;  // scenes without an answer
  std::string received_;
};

PictureMakers::PictureMakers(const std::string& folder, std::size_t count, bool keep) {
  for (std::size_t i = 0; i < count; ++i) makers_.push_back(std::make_unique<Maker>(folder, i + 1, keep));
}

PictureMakers::~PictureMakers() = default;

void PictureMakers::make(const std::string& scene) { makers_[next_++ % makers_.size()]->make(scene); }

void PictureMakers::finish() {
  for (const auto& maker : makers_) maker->finish();
}

}  // namespace ensonify::dataset
