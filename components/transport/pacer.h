#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace ensonify {

/// A queue of datagrams that leave in their order at a rate, so that a burst does not overrun the receiver's buffer. It
/// holds what leaves within kLongest; what does not fit is dropped, a whole datagram each time. One fits always.
///
/// A value: it is given the time, of any clock that does not go back.
class Pacer {
 public:
  using Time = std::chrono::nanoseconds;
  static constexpr Time kLongest = std::chrono::seconds(2);
  static constexpr Time kCatchUp = std::chrono::milliseconds(2);  // of the rate, where it was asked late

  struct Datagram {
    std::vector<std::byte> bytes;
    Time offered{0};
  };

  explicit Pacer(double bytes_per_s) : bytes_per_s_(bytes_per_s) {}

  /// False: it did not fit and is dropped.
  bool offer(std::vector<std::byte> bytes, Time now);
  /// When the first may leave; nothing where none waits.
  std::optional<Time> next() const;
  /// The first, if it may leave now.
  std::optional<Datagram> take(Time now);

  std::size_t waiting() const { return queue_.size(); }
  std::size_t waiting_bytes() const { return waiting_bytes_; }

 private:
  Time duration(std::size_t bytes) const;

  double bytes_per_s_;
  std::deque<Datagram> queue_;
  std::size_t waiting_bytes_ = 0;
  std::optional<Time> free_;  // when what left last has passed, at the rate
};

}  // namespace ensonify
