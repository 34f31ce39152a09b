#include "components/transport/pacer.h"

#include <algorithm>
#include <utility>

namespace ensonify {

Pacer::Time Pacer::duration(std::size_t bytes) const {
  return Time{static_cast<Time::rep>(1e9 * static_cast<double>(bytes) / bytes_per_s_)};
}

bool Pacer::offer(std::vector<std::byte> bytes, Time now) {
  if (!queue_.empty() && duration(waiting_bytes_ + bytes.size()) > kLongest) return false;
  waiting_bytes_ += bytes.size();
  queue_.push_back({std::move(bytes), now});
  return true;
}

std::optional<Pacer::Time> Pacer::next() const {
  if (queue_.empty()) return std::nullopt;
  return free_ ? std::max(*free_, queue_.front().offered) : queue_.front().offered;
}

std::optional<Pacer::Datagram> Pacer::take(Time now) {
  const auto due = next();
  if (!due || *due > now) return std::nullopt;
  Datagram first = std::move(queue_.front());
  queue_.pop_front();
  waiting_bytes_ -= first.bytes.size();
  free_ = std::max(*due, now - kCatchUp) + duration(first.bytes.size());
  return first;
}

}  // namespace ensonify
