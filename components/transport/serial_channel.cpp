#include <poll.h>

#include <thread>
#include <utility>

#include "components/transport/channel.h"
#include "components/transport/descriptor.h"
#include "components/transport/serial_line.h"

namespace ensonify {
namespace {

class SerialChannel : public Channel {
 public:
  SerialChannel(const std::string& path, int baud) : path_(path), baud_(baud), line_(serial::must_open(path, baud)) {}

  std::optional<Piece> wait(std::chrono::milliseconds limit) override {
    if (!line_.is_open() && !reopen()) {
      std::this_thread::sleep_for(std::min<std::chrono::milliseconds>(limit, serial::kTryAgain));
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
  bool reopen() {
    line_ = serial::open(path_, baud_);
    if (!line_.is_open()) return false;
    begins_ = true;
    trouble_.clear();
    return true;
  }

  std::string path_;
  int baud_;
  Descriptor line_;
  bool begins_ = true;
};

}  // namespace

std::unique_ptr<Channel> serial_channel(const std::string& path, int baud) {
  return std::make_unique<SerialChannel>(path, baud);
}

}  // namespace ensonify
