#include <chrono>

#include "components/transport/outlet.h"
#include "components/transport/sender.h"
#include "components/transport/serial_line.h"

namespace ensonify {
namespace {

class SerialSender : public Sender {
 public:
  SerialSender(const std::string& path, int baud) : path_(path), baud_(baud), line_(serial::must_open(path, baud)) {}

  Outcome send(std::span<const std::byte> piece) override {
    if (!line_.is_open() && !reopen()) return Outcome::unreachable;
    switch (line_.write(piece)) {
      case Outlet::Result::taken: return Outcome::sent;
      case Outlet::Result::busy: return Outcome::busy;
      default: return Outcome::unreachable;
    }
  }

 private:
  bool reopen() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_try_) return false;
    next_try_ = now + serial::kTryAgain;
    line_ = Outlet(serial::open(path_, baud_));
    return line_.is_open();
  }

  std::string path_;
  int baud_;
  Outlet line_;
  std::chrono::steady_clock::time_point next_try_{};
};

}  // namespace

std::unique_ptr<Sender> serial_sender(const std::string& path, int baud) {
  return std::make_unique<SerialSender>(path, baud);
}

}  // namespace ensonify
