#include "components/transport/serial_line.h"

#include <fcntl.h>
#include <termios.h>

#include <cerrno>
#include <cstring>
#include <map>

#include "components/errors/exit_error.h"

namespace ensonify::serial {
namespace {

speed_t speed_of(int baud) {
  static const std::map<int, speed_t> kSpeeds{{4800, B4800},     {9600, B9600},     {19200, B19200},
                                              {38400, B38400},   {57600, B57600},   {115200, B115200},
                                              {230400, B230400}, {460800, B460800}, {921600, B921600}};
  const auto found = kSpeeds.find(baud);
  if (found != kSpeeds.end()) return found->second;
  throw UserError(std::to_string(baud) +
                  " baud is no rate of a serial line; allowed: 4800 and its doubles, 57600 and its doubles to 921600");
}

}  // namespace

void check_baud(int baud) { speed_of(baud); }

Descriptor open(const std::string& path, int baud) {
  const speed_t speed = speed_of(baud);
  Descriptor line(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  termios settings{};
  if (!line.is_open() || ::tcgetattr(line.get(), &settings) != 0) return Descriptor();
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  ::cfsetispeed(&settings, speed);
  ::cfsetospeed(&settings, speed);
  if (::tcsetattr(line.get(), TCSANOW, &settings) != 0) return Descriptor();
  return line;
}

Descriptor must_open(const std::string& path, int baud) {
  Descriptor line = open(path, baud);
  if (line.is_open()) return line;
  throw UserError("cannot open the serial line " + path + ": " + std::strerror(errno) +
                  "; allowed: a line such as /dev/ttyUSB0");
}

}  // namespace ensonify::serial
