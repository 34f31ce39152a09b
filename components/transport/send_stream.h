#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "components/transport/pacer.h"
#include "components/transport/sender.h"

namespace ensonify {

/// Datagrams, or pieces of a stream, by one way, at a rate in wall time, sent by a thread of its own: who offers them
/// never waits.
class SendStream {
 public:
  static constexpr std::chrono::milliseconds kLate{100};

  struct Counts {
    std::int64_t datagrams = 0;  // sent,
    std::int64_t bytes = 0;      // and theirs
    std::int64_t lost = 0;     // never sent: no room in the queue, no way there, too long, or still waiting at the end
    std::int64_t refused = 0;  // sent, and not taken at the other end (Sender::refused)
    std::int64_t late = 0;     // sent more than kLate after they were offered
    double latest_s = 0.0;     // the longest that one waited
  };

  SendStream(std::unique_ptr<Sender> sender, double bytes_per_s);
  /// What waits is not sent.
  ~SendStream();
  SendStream(const SendStream&) = delete;
  SendStream& operator=(const SendStream&) = delete;

  void offer(std::vector<std::byte> datagram);
  /// Sends what waits, for as long as that may take (Pacer::kLongest) and no longer; the rest is lost. Then it is over.
  void finish();
  Counts counts() const;

 private:
  void run();
  Sender::Outcome send(const Pacer::Datagram& datagram);
  static Pacer::Time now() { return std::chrono::steady_clock::now().time_since_epoch(); }

  std::unique_ptr<Sender> sender_;  // the thread's
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Pacer pacer_;  // under the mutex, as are:
  Counts counts_;
  bool over_ = false;
  Pacer::Time until_ = Pacer::Time::max();  // what waits then is lost
  std::thread thread_;
};

}  // namespace ensonify
