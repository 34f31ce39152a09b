#include "components/runtime/participant.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "components/errors/exit_error.h"
#include "components/runtime/injections.h"
#include "components/runtime/log.h"
#include "components/runtime/peer.h"
#include "components/runtime/protocol.h"
#include "components/runtime/termination.h"

namespace ensonify {

namespace {

/// The loop between HELLO and END.
class Participant {
 public:
  Participant(const OpenSession& open, const Meeting& meeting)
      : open_(open),
        session_(open({})),
        link_(session_->ports().process(), meeting.clock_endpoint, meeting.address,
              queue_length(session_->declaration(), kLongestWindow)) {}

  int run() {
    say_hello();
    while (true) {
      const bus::Link::Event event = next_event();
      if (event.kind == bus::Link::Event::kClockLost) throw ExitError(kExitDied, "the clock is gone");
      if (event.kind == bus::Link::Event::kTokens) {
        report_proven(event.tokens);
      } else if (const auto grant = protocol::read_grant(event.control)) {
        run_grant(*grant);
      } else {
        const std::string kind = protocol::kind_of(event.control);
        if (kind == "late") late_ = protocol::read_late(event.control);
        if (kind == "lost") link_.lost(protocol::read_lost(event.control));
        if (kind == "welcome") welcome(event.control);
        if (kind == "epoch") begin(protocol::read_epoch(event.control));
        if (kind == "refused") return refused(event.control);
        if (kind == "end") return end(protocol::read_code(event.control));
      }
    }
  }

  bool completes_files() const { return session_->node().completes_files(); }

  /// From another thread: run() throws.
  void interrupt() { link_.interrupt(); }

  /// The launch kills this process. The others know of all that it has published.
  void leave() { link_.leave(); }

  void report_failed(const protocol::Failed& failed) { link_.send_control(protocol::encode_failed(failed)); }

 private:
  void say_hello() {
    protocol::Hello hello;
    hello.declaration = session_->declaration();
    hello.pid = getpid();
    hello.epoch = epoch_;
    hello.resets = true;
    hello.sync_endpoint = link_.sync_endpoint();
    hello.live_endpoint = link_.live_endpoint();
    link_.send_control(protocol::encode(hello));
  }

  /// Once time has started the clock alone has something to say, unless it is gone.
  bus::Link::Event next_event() {
    if (!heard_.empty()) {
      bus::Link::Event first{bus::Link::Event::kControl, std::move(heard_.front()), {}};
      heard_.pop_front();
      return first;
    }
    if (granted_) {
      if (auto control = link_.wait_control()) return {bus::Link::Event::kControl, std::move(*control), {}};
    }
    return link_.wait();
  }

  void welcome(const std::string& text) {
    protocol::Welcome w = protocol::read_welcome(text, session_->ports().outs(), session_->ports().ins());
    epoch_ = w.epoch;
    patience_ = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * w.patience_s));
    std::vector<Feed> feeds;
    std::vector<bus::Subscription> subscriptions;
    may_be_lost_.clear();
    for (const protocol::WelcomeIn& in : w.ins) {
      const Feed& c = in.feed;
      feeds.push_back(c);
      subscriptions.push_back({c.topic, c.topic_id, c.type, in.endpoint, in.token, c.max_bytes, c.publisher, c.rank,
                               c.rate, c.may_be_lost});
      if (c.may_be_lost) may_be_lost_.insert(c.topic_id);
    }
    session_->stepper().wire(std::move(feeds), std::move(w.outs), std::move(w.facts), w.epoch, w.rank,
                             [this](msg::Packet&& packet) { link_.publish(packet); },
                             {.watched = [this](const std::string& topic) { return link_.is_watched(topic); },
                              .send = [this](msg::Packet&& packet) { link_.publish_live(packet); },
                              .late = [this] { return late_; }});
    early_.clear();
    link_.subscribe(subscriptions, w.epoch);
    if (wired_) link_.send_control(R"({"kind":"ready"})");
    wired_ = true;
  }

  /// The epoch before has been run to its end. What is left of it goes before its successor comes: files and sockets
  /// may be the same.
  void begin(const protocol::Begin& next) {
    finish();
    session_.reset();
    epoch_ = next.epoch;
    session_ = open_({next.sets, next.out});
    say_hello();
  }

  void report_proven(const std::vector<std::string>& tokens) { link_.send_control(protocol::encode_proven(tokens)); }

  void run_grant(const protocol::Grant& grant) {
    if (grant.epoch != epoch_) return;
    granted_ = true;
    Stepper& stepper = session_->stepper();
    link_.wait_arrived(grant.inputs, patience_, [this] { hear(); });
    for (const msg::Packet& packet : counted_in(grant)) {
      if (stepper.too_late(packet)) refuse(packet);
      else stepper.insert(packet);
    }
    for (const bus::Unusable& topic : link_.take_unusable()) stepper.close(topic.topic_id, topic.t, topic.why);
    const auto begin = std::chrono::steady_clock::now();
    protocol::Done done;
    std::optional<InjectedKill> killed;
    try {
      done.finish = stepper.run_to(grant.horizon);
    } catch (const InjectedKill& kill) {
      killed = kill;  // the events before that one have been run
    }
    for (const auto& [at, why] : stepper.take_unusable())
      link_.send_control(protocol::encode(protocol::Unusable{at, {why.code, why.what(), why.culprit}}));
    link_.flush();
    done.cost_ns = (std::chrono::steady_clock::now() - begin).count();
    link_.expect_until(saturating_add(stepper.next(), kLongestWindow));
    done.epoch = epoch_;
    done.next = done.finish ? stepper.last() + SimTime{1} : stepper.next();
    for (std::size_t i = 0; i < stepper.outs().size(); ++i) {
      done.outputs.emplace_back(stepper.outs()[i].topic_id, stepper.published()[i]);
    }
    link_.send_control(protocol::encode(done));
    if (killed) throw InjectedKill(*killed);
  }

  /// What comes of the clock while this process waits for data is for later, but that a publisher is lost.
  void hear() {
    while (auto control = link_.take_control()) {
      if (protocol::kind_of(*control) == "lost") link_.lost(protocol::read_lost(*control));
      else heard_.push_back(std::move(*control));
    }
  }

  /// What has come and the grant counts, in order per topic. What it does not count waits: should its publisher be lost
  /// before it has counted it, nobody reads it.
  std::vector<msg::Packet> counted_in(const protocol::Grant& grant) {
    std::vector<msg::Packet> packets = std::exchange(early_, {});
    std::vector<msg::Packet> fresh = link_.take();
    packets.insert(packets.end(), std::make_move_iterator(fresh.begin()), std::make_move_iterator(fresh.end()));
    const auto is_counted = [&](const msg::Packet& packet) {
      return std::ranges::any_of(grant.inputs, [&](const auto& input) {
        return input.first == packet.envelope.topic_id && packet.envelope.seq < input.second;
      });
    };
    const auto early = std::stable_partition(packets.begin(), packets.end(), is_counted);
    early_.assign(std::make_move_iterator(early), std::make_move_iterator(packets.end()));
    packets.erase(early, packets.end());
    return packets;
  }

  /// It breaks a promise.
  void refuse(const msg::Packet& packet) {
    const std::string publisher = packet.topic.substr(0, packet.topic.find('/'));
    const PeerError why =
        broken_message(publisher, packet.topic, packet.envelope.seq,
                       fmt::format("t_sim: {} ns is before the `next` of an earlier DONE", packet.envelope.t_sim_ns));
    if (!may_be_lost_.contains(packet.envelope.topic_id)) throw PeerError(why);
    session_->stepper().close(packet.envelope.topic_id, SimTime{packet.envelope.t_sim_ns}, why);
  }

  int refused(const std::string& text) {
    for (const std::string& problem : protocol::read_problems(text))
      log::line(session_->ports().process(), SimTime{0}, "refused", problem);
    return kExitUserError;
  }

  int end(int code) {
    if (code == 0) finish();
    else note_exit_code();
    link_.send_control(R"({"kind":"bye"})");
    return exit_code_;
  }

  void finish() {
    session_->node().finish_run();
    note_exit_code();
  }

  void note_exit_code() {
    if (exit_code_ == kExitOk) exit_code_ = session_->node().exit_code();
  }

  OpenSession open_;
  std::unique_ptr<Session> session_;
  bus::Link link_;
  std::vector<msg::Packet> early_;       // of the epoch
  std::set<std::uint32_t> may_be_lost_;  // topics
  std::deque<std::string> heard_;        // of the clock, out of turn
  std::uint32_t epoch_ = 1;
  int exit_code_ = kExitOk;  // of the first epoch that has one
  std::chrono::milliseconds patience_{0};
  bool wired_ = false;  // edges are proven once
  bool granted_ = false;
  bool late_ = false;  // says the clock, to who has ports for viewers
};

}  // namespace

int participate(const OpenSession& open, const Meeting& meeting) {
  Participant participant(open, meeting);
  std::optional<Termination> termination;
  if (participant.completes_files()) termination.emplace([&] { participant.interrupt(); });
  try {
    return participant.run();
  } catch (const InjectedKill& kill) {
    participant.leave();
    ::kill(::getpid(), kill.signal);
    return kExitInterrupted;  // files are completed as the node goes
  } catch (const std::exception& e) {
    if (termination && termination->asked()) return kExitInterrupted;  // files are completed as the node goes
    const auto* known = dynamic_cast<const ExitError*>(&e);
    const auto* peer = dynamic_cast<const PeerError*>(&e);
    participant.report_failed({known ? known->code : kExitDied, e.what(), peer ? peer->culprit : ""});
    throw;
  }
}

}  // namespace ensonify
