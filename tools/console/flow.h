#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/view/ping_view.h"
#include "messages/codec.h"
#include "messages/console.h"

namespace ensonify::console {

using WallTime = std::chrono::steady_clock::time_point;

/// How a message reaches a viewer: the newest state of a topic, sent when it changes; lines (and values), all of them
/// in order within a bound; pictures, of which one is on its way at a time and then the newest follows.
enum class Way { state, line, picture };

/// Something that a viewer may want. The packet of a ping is a ping still: it becomes a picture when it is sent.
struct Offer {
  std::string topic;
  Way way = Way::state;
  std::shared_ptr<const msg::Packet> packet;
  WallTime arrived;
};

/// What to send next.
struct Sending {
  Offer offer;
  PictureWish wish;  // of a picture or line of a head
};

/// What waits for one viewer, and what it is sent when. No sockets: time is given, so that it can be tested.
///
/// Nothing grows without bound: of a state the newest is kept, of lines kMostLines a topic, of pictures one. What small
/// messages say comes before lines, and these before pictures. A viewer that is hidden, or has not answered for
/// kPatience, is sent nothing; when it is back it gets all states, the newest pictures, and lines from then on.
class Flow {
 public:
  static constexpr std::size_t kMostTopics = 64;
  static constexpr std::size_t kMostValues = 32;
  static constexpr std::size_t kMostLines = 512;  // of a topic that wait
  static constexpr std::size_t kLinesAhead = 64;  // of a topic that were sent and not yet drawn
  static constexpr std::size_t kLeastCells = 16;
  static constexpr std::size_t kMostCells = 1024;
  static constexpr int kMostHalvings = 4;
  static constexpr std::size_t kInLink = 16'384;          // bytes in the link beyond which only states are sent
  static constexpr std::chrono::milliseconds kSlow{250};  // a picture that needs more of the link is halved
  static constexpr std::chrono::milliseconds kFast{60};   // after kFastEnough of these in a row it is doubled again
  static constexpr int kFastEnough = 20;
  static constexpr std::chrono::seconds kPatience{5};

  explicit Flow(WallTime now);

  /// What the viewer watches from now on. Throws msg::DecodeError naming what is not allowed.
  void watch(const msg::ConsoleWatch& wish, WallTime now);
  bool watches(const std::string& topic) const;
  const std::vector<msg::ConsoleWatched>& watched() const { return wish_.topics; }
  /// Names of numbers, TOPIC.field.
  const std::vector<std::string>& values() const { return wish_.values; }

  /// Its ranges are to lie on the ground.
  bool wishes_ground(const std::string& topic) const;

  /// Something of this topic has not been sent yet.
  bool has_waiting(const std::string& topic) const;

  /// Takes it if the viewer watches its topic. `always`: what every viewer gets (console_state/1).
  void offer(const Offer& offer, bool always = false);
  /// The next message for the link, in which so many bytes are on their way. Nothing: there is none that may go, or the
  /// viewer does not answer.
  std::optional<Sending> next(WallTime now, std::size_t in_link = 0);
  /// That message was so many bytes.
  void sent(std::size_t bytes);
  /// Called again and again: whether the link is empty. From it follows how long messages need, however busy the viewer
  /// is.
  void passed(WallTime now, bool empty);
  /// The viewer has drawn a message.
  void drawn(const std::string& topic, std::uint64_t seq, WallTime now);
  /// Something came from the viewer. True when it had been away: offer() all states anew.
  bool answered(WallTime now);
  bool away(WallTime now) const;

  /// The report of the last second, which is also what the viewer's answers are timed by.
  msg::ConsoleFlow report(WallTime now);

 private:
  struct OnItsWay {
    std::uint64_t seq = 0;
    WallTime arrived;
  };
  struct InLink {
    std::string topic;
    WallTime began;
    std::size_t bytes = 0;
  };
  struct Topic {
    Way way = Way::state;
    PictureWish wish;
    std::deque<Offer> waiting;
    std::deque<OnItsWay> on_its_way;
    int halved = 0;
    int fast = 0;
    std::int64_t sent = 0;
    std::int64_t lost = 0;
    std::int64_t reported = 0;
    double age_s = 0.0;
  };

  Topic* ready(Way way);
  void judge(std::chrono::nanoseconds took);

  msg::ConsoleWatch wish_;
  std::map<std::string, Topic> topics_;
  std::string last_topic_;              // behind which the next turn begins
  std::optional<InLink> next_in_link_;  // to which sent() refers
  std::optional<InLink> in_link_;       // the message whose passage is timed: the largest of those in the link
  WallTime answered_;
  WallTime reported_;
  bool was_away_ = false;
  double link_bytes_per_s_ = 0.0;
};

}  // namespace ensonify::console
