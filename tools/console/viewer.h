#pragma once

#include <functional>
#include <memory>
#include <string>

#include "tools/console/doors.h"
#include "tools/console/flow.h"
#include "tools/console/logs.h"
#include "tools/console/server/server.h"
#include "tools/console/survey.h"
#include "tools/console/values.h"

namespace ensonify::console {

class Desk;
class Console;

/// One page: what it says and what it is sent.
class Viewer : public Visitor {
 public:
  static constexpr std::size_t kMostPerSecond = 50;  // messages that are no answers
  static constexpr std::chrono::seconds kEnterWithin{2};

  Viewer(Console& console, Line& line, WallTime now);
  ~Viewer() override;

  void said(std::string_view text) override;
  void sent() override;

  void tick(WallTime now);
  /// Of its desk, when that has changed.
  void send_state();
  const Desk* desk() const { return desk_.get(); }
  bool entered() const { return power_.has_value(); }

 private:
  void take(const std::string& type, const msg::Value& message, WallTime now);
  void sit_at(const std::string& id);
  void answer(const std::string& request, const std::string& error);
  void push(WallTime now);
  void fetch_news();
  template <msg::Message M>
  void offer_own(const std::string& topic, const M& message, Way way);

  Console& console_;
  Line& line_;
  WallTime came_;
  std::optional<Power> power_;
  std::shared_ptr<Desk> desk_;
  Flow flow_;
  Survey::Seen seen_;
  Values::Seen seen_values_;
  Logs::Seen seen_log_;
  WallTime fetched_;
  bool busy_ = false;  // a message is on its way into the socket
  std::uint64_t seq_ = 0;
  WallTime second_;
  std::size_t said_ = 0;  // in this second
};

}  // namespace ensonify::console
