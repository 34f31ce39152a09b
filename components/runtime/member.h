#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "components/runtime/bus/link.h"
#include "components/runtime/protocol.h"
#include "components/runtime/session.h"

namespace ensonify {

/// Addresses of the others for a participant.
struct Meeting {
  std::string clock_endpoint;  // "": the clock is in this process
  bus::Address address;
};

/// Participants of one program: what goes between them is handed over, not sent.
class Neighbours {
 public:
  virtual ~Neighbours() = default;
  virtual bool is_one(const std::string& process) const = 0;
  /// `reader` takes this topic of one of them, whose token stands for the proof that it gets there.
  virtual void read(const std::string& reader, const bus::Subscription& topic) = 0;
  virtual void hand_over(const msg::Packet& packet) = 0;
};

/// One process's part in a run between HELLO and END, as the clock drives it: it takes one word of the clock at a time.
/// Only run() waits, and no longer than it is told to. Each throws what the node or the bus throws; then nothing but
/// leave() may be called.
class Member {
 public:
  /// `say` carries words to the clock. Alone in its program it has no neighbours.
  using Say = std::function<void(std::string_view)>;
  Member(const OpenSession& open, const Meeting& meeting, Say say = {}, Neighbours* neighbours = nullptr);
  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;

  const std::string& name() const { return name_; }
  const AnyNode& node() const { return session_->node(); }
  bus::Link& link() { return link_; }

  void say_hello();
  void say_proven(const std::vector<std::string>& tokens);
  void say_failed(const protocol::Failed& failed);
  void take(const std::string& word);

  /// It has a grant, which counts what may not have come yet.
  bool has_grant() const { return grant_.has_value(); }
  /// Runs the grant once all that it counts has come; false if that takes longer than `patience`.
  bool run(std::chrono::milliseconds patience);
  /// A neighbour's message.
  void hand_over(const msg::Packet& packet) { session_->stepper().insert(packet); }

  /// Time has started: the clock alone has something to say.
  bool has_run() const { return has_run_; }
  /// It has taken leave, with this exit code: that of the first epoch whose node has one.
  bool is_over() const { return over_; }
  int exit_code() const { return exit_code_; }

 private:
  void welcome(const std::string& text);
  void begin(const protocol::Begin& next);
  void refused(const std::string& text);
  void end(int code);
  void finish();
  void note_exit_code();
  bool all_is_here(std::chrono::milliseconds patience);
  void take_packets();
  std::vector<msg::Packet> counted();
  void refuse(const msg::Packet& packet);
  void run_grant();

  OpenSession open_;
  std::unique_ptr<Session> session_;
  std::string name_;
  bus::Link link_;
  Say say_;
  Neighbours* neighbours_;
  std::optional<protocol::Grant> grant_;  // its counts are of what comes by the link
  std::chrono::milliseconds waited_{0};   // for it, since the last message came
  std::chrono::milliseconds patience_{0};
  std::vector<msg::Packet> early_;       // of the epoch
  std::set<std::uint32_t> handed_over_;  // topics of neighbours
  std::set<std::uint32_t> may_be_lost_;  // topics
  std::uint32_t epoch_ = 1;
  int exit_code_ = 0;
  bool receives_ = false;
  bool wired_ = false;  // edges are proven once
  bool has_run_ = false;
  bool over_ = false;
  bool late_ = false;  // says the clock, to who has ports for viewers
};

/// What a participant says when this ends it.
protocol::Failed failure_of(const std::exception& e);

}  // namespace ensonify
