#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <thread>
#include <utility>

#include "components/errors/exit_error.h"
#include "components/transport/channel.h"
#include "components/transport/descriptor.h"

namespace ensonify {
namespace {

constexpr std::chrono::seconds kTryAgain{1};

speed_t speed_of(int baud) {
  static const std::map<int, speed_t> kSpeeds{{4800, B4800},     {9600, B9600},     {19200, B19200},
                                              {38400, B38400},   {57600, B57600},   {115200, B115200},
                                              {230400, B230400}, {460800, B460800}, {921600, B921600}};
  const auto found = kSpeeds.find(baud);
  if (found != kSpeeds.end()) return found->second;
  throw UserError(std::to_string(baud) +
                  " baud is no rate of a serial line; allowed: 4800 and its doubles, 57600 and its doubles to 921600");
}

/// Eight bits, no parity, one stop bit, every byte as it comes.
class SerialChannel : public Channel {
 public:
  SerialChannel(const std::string& path, int baud) : path_(path), speed_(speed_of(baud)) {
    if (!open()) {
      throw UserError("cannot open the serial line " + path + ": " + std::strerror(errno) +
                      "; allowed: a line such as /dev/ttyUSB0");
    }
  }

  std::optional<Piece> wait(std::chrono::milliseconds limit) override {
    if (!line_.is_open() && !open()) {
      std::this_thread::sleep_for(std::min<std::chrono::milliseconds>(limit, kTryAgain));
      return std::nullopt;
    }
    if (!comes_within(line_, POLLIN, limit)) return std::nullopt;
    auto bytes = read_some(line_);
    if (!bytes) {  // unplugged
      line_.reset();
      trouble_ = "the serial line " + path_ + " is gone";
      std::this_thread::sleep_for(limit);
      return std::nullopt;
    }
    if (bytes->empty()) return std::nullopt;
    return Piece{std::move(*bytes), std::exchange(begins_, false), false};
  }

 private:
  bool open() {
    Descriptor line(::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    termios settings{};
    if (!line.is_open() || ::tcgetattr(line.get(), &settings) != 0) return false;
    ::cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    ::cfsetispeed(&settings, speed_);
    ::cfsetospeed(&settings, speed_);
    if (::tcsetattr(line.get(), TCSANOW, &settings) != 0) return false;
    line_ = std::move(line);
    begins_ = true;
    trouble_.clear();
    return true;
  }

  std::string path_;
  speed_t speed_;
  Descriptor line_;
  bool begins_ = true;
};

}  // namespace

std::unique_ptr<Channel> serial_channel(const std::string& path, int baud) {
  return std::make_unique<SerialChannel>(path, baud);
}

}  // namespace ensonify
