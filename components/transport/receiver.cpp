#include "components/transport/receiver.h"

#include <utility>

namespace ensonify {
namespace {

constexpr std::chrono::milliseconds kLooksUp{50};  // for the end

}  // namespace

Receiver::Receiver(std::unique_ptr<Channel> channel) : channel_(std::move(channel)) {
  state_.trouble = channel_->trouble();
  thread_ = std::thread([this] { run(); });
}

Receiver::~Receiver() {
  stop_ = true;
  thread_.join();
}

void Receiver::run() {
  while (!stop_) {
    auto piece = channel_->wait(kLooksUp);
    const auto now = Clock::now();
    const std::lock_guard lock(mutex_);
    state_.refused = channel_->refused();
    state_.trouble = channel_->trouble();
    if (!piece) continue;
    const std::size_t size = piece->bytes.size();
    if (bytes_ + size > kMostBytes || arrived_.size() >= kMostPieces) {
      state_.dropped_bytes += size;
      continue;
    }
    bytes_ += size;
    arrived_.push_back({std::move(*piece), now});
  }
}

std::optional<Receiver::Arrival> Receiver::take() {
  const std::lock_guard lock(mutex_);
  if (arrived_.empty()) return std::nullopt;
  Arrival arrival = std::move(arrived_.front());
  arrived_.pop_front();
  bytes_ -= arrival.piece.bytes.size();
  return arrival;
}

Receiver::State Receiver::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

}  // namespace ensonify
