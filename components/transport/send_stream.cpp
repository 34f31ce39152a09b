#include "components/transport/send_stream.h"

#include <algorithm>
#include <utility>

namespace ensonify {

namespace {

constexpr std::chrono::milliseconds kAgain{1};  // where the sender was busy

}  // namespace

SendStream::SendStream(std::unique_ptr<Sender> sender, double bytes_per_s)
    : sender_(std::move(sender)), pacer_(bytes_per_s), thread_([this] { run(); }) {}

SendStream::~SendStream() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    until_ = now();
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void SendStream::offer(std::vector<std::byte> datagram) {
  {
    const std::lock_guard lock(mutex_);
    if (over_ || !pacer_.offer(std::move(datagram), now())) ++counts_.lost;
  }
  changed_.notify_one();
}

void SendStream::finish() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    until_ = std::min(until_, now() + Pacer::kLongest + kLate);
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

SendStream::Counts SendStream::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

void SendStream::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto next = pacer_.next();
    if (over_ && (!next || now() >= until_)) break;
    if (!next) {
      changed_.wait(lock);
      continue;
    }
    const auto datagram = pacer_.take(now());
    if (!datagram) {
      changed_.wait_until(lock, std::chrono::steady_clock::time_point(std::min(*next, until_)));
      continue;
    }
    lock.unlock();
    const Sender::Outcome outcome = send(*datagram);
    const double waited_s = std::chrono::duration<double>(now() - datagram->offered).count();
    lock.lock();
    counts_.refused = sender_->refused();
    if (outcome != Sender::Outcome::sent) {
      ++counts_.lost;
      continue;
    }
    ++counts_.datagrams;
    counts_.bytes += static_cast<std::int64_t>(datagram->bytes.size());
    counts_.latest_s = std::max(counts_.latest_s, waited_s);
    if (waited_s > std::chrono::duration<double>(kLate).count()) ++counts_.late;
  }
  counts_.lost += static_cast<std::int64_t>(pacer_.waiting());
}

/// Tries for as long as the datagram may wait.
Sender::Outcome SendStream::send(const Pacer::Datagram& datagram) {
  for (;;) {
    const Sender::Outcome outcome = sender_->send(datagram.bytes);
    if (outcome != Sender::Outcome::busy || now() > datagram.offered + Pacer::kLongest) return outcome;
    std::this_thread::sleep_for(kAgain);
  }
}

}  // namespace ensonify
