#pragma once

#include <chrono>
#include <deque>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "components/runtime/bus/router.h"
#include "components/runtime/member.h"

namespace ensonify {

/// The clock's control plane where participants live in its own program: to the clock, to everybody else and to viewers
/// they are like any other. Words and messages between them are handed over, and they run their grants in turn while
/// the clock waits for its next message. The same bytes as separate processes, without the switches between them.
class Host : public bus::ControlPlane, private Neighbours {
 public:
  /// `outside` is where the others take part; `address` is for the members' sockets.
  Host(bus::Router& outside, bus::Address address) : outside_(outside), address_(std::move(address)) {}
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// A member more. Throws what its node throws, and UserError for one that has files to complete at whatever end.
  void add(const OpenSession& open);
  /// All of them say HELLO.
  void join();

  std::optional<Message> wait(std::optional<bus::WallTime> until) override;
  bool send(const std::string& to, std::string_view text) override;
  const std::string& live_endpoint() const override { return outside_.live_endpoint(); }
  void publish_live(const msg::Packet& packet) override { outside_.publish_live(packet); }

 private:
  struct Hosted {
    Hosted(Host& host, const OpenSession& open, const Meeting& meeting);
    Member member;
    bool failed = false;  // nothing more is asked of it
  };

  bool is_one(const std::string& process) const override { return members_.contains(process); }
  void read(const std::string& reader, const bus::Subscription& topic) override;
  void hand_over(const msg::Packet& packet) override;

  void work(Hosted& hosted, const std::string& word);
  void run(Hosted& hosted, std::chrono::milliseconds patience);
  void fail(Hosted& hosted, const std::exception& e);
  void prove();

  bus::Router& outside_;
  bus::Address address_;
  std::unordered_map<std::string, std::unique_ptr<Hosted>> members_;
  std::deque<Message> said_;                                         // by members, to the clock
  std::deque<std::pair<Hosted*, std::string>> words_;                // of the clock, to members
  std::deque<Hosted*> waiting_;                                      // with a grant that counts what has not come yet
  std::unordered_map<std::uint32_t, std::vector<Member*>> readers_;  // by topic id
  bool started_ = false;                                             // time runs: every edge is proven
};

}  // namespace ensonify
