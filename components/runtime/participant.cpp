#include "components/runtime/participant.h"

#include <unistd.h>

#include <chrono>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/runtime/log.h"
#include "components/runtime/peer.h"
#include "components/runtime/protocol.h"
#include "components/runtime/termination.h"

namespace ensonify {

namespace {

/// The loop between HELLO and END.
class Participant {
 public:
  Participant(const std::string& component, Ports& ports, AnyNode& node, const Meeting& meeting)
      : ports_(ports),
        node_(node),
        declaration_(declaration_of(component, ports)),
        stepper_(ports, [&node](SimTime now) { return node.step(now); }),
        link_(ports.process(), meeting.clock_endpoint, meeting.address, queue_length(declaration_, kLongestWindow)) {}

  int run() {
    link_.send_control(protocol::encode(
        protocol::Hello{declaration_, getpid(), SimTime{0}, link_.sync_endpoint(), link_.live_endpoint(), {}}));
    while (true) {
      const bus::Link::Event event = next_event();
      if (event.kind == bus::Link::Event::kClockLost) throw ExitError(kExitDied, "the clock is gone");
      if (event.kind == bus::Link::Event::kTokens) {
        report_proven(event.tokens);
      } else if (const auto grant = protocol::read_grant(event.control)) {
        run_grant(*grant);
      } else {
        const std::string kind = protocol::kind_of(event.control);
        if (kind == "welcome") welcome(event.control);
        if (kind == "refused") return refused(event.control);
        if (kind == "end") return end(protocol::read_code(event.control));
      }
    }
  }

  /// From another thread: run() throws.
  void interrupt() { link_.interrupt(); }

  void report_failed(const protocol::Failed& failed) { link_.send_control(protocol::encode_failed(failed)); }

 private:
  /// Once time has started the clock alone has something to say, unless it is gone.
  bus::Link::Event next_event() {
    if (granted_) {
      if (auto control = link_.wait_control()) return {bus::Link::Event::kControl, std::move(*control), {}};
    }
    return link_.wait();
  }

  void welcome(const std::string& text) {
    protocol::Welcome w = protocol::read_welcome(text, ports_.outs(), ports_.ins());
    epoch_ = w.epoch;
    patience_ = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * w.patience_s));
    std::vector<Feed> feeds;
    std::vector<bus::Subscription> subscriptions;
    for (const protocol::WelcomeIn& in : w.ins) {
      const Feed& c = in.feed;
      feeds.push_back(c);
      subscriptions.push_back(
          {c.topic, c.topic_id, c.type, in.endpoint, in.token, c.max_bytes, c.publisher, c.rank, c.rate});
    }
    stepper_.wire(std::move(feeds), std::move(w.outs), std::move(w.facts), w.epoch, w.rank,
                  [this](msg::Packet&& packet) { link_.publish(packet); });
    link_.subscribe(subscriptions, w.epoch);
  }

  void report_proven(const std::vector<std::string>& tokens) { link_.send_control(protocol::encode_proven(tokens)); }

  void run_grant(const protocol::Grant& grant) {
    if (grant.epoch != epoch_) return;
    granted_ = true;
    link_.wait_arrived(grant.inputs, patience_);
    for (const msg::Packet& packet : link_.take()) {
      if (stepper_.too_late(packet)) throw broken_promise(packet);
      stepper_.insert(packet);
    }
    const auto begin = std::chrono::steady_clock::now();
    protocol::Done done;
    done.finish = stepper_.run_to(grant.horizon);
    link_.flush();
    done.cost_ns = (std::chrono::steady_clock::now() - begin).count();
    link_.expect_until(saturating_add(stepper_.next(), kLongestWindow));
    done.epoch = epoch_;
    done.next = done.finish ? stepper_.last() + SimTime{1} : stepper_.next();
    for (std::size_t i = 0; i < stepper_.outs().size(); ++i) {
      done.outputs.emplace_back(stepper_.outs()[i].topic_id, stepper_.published()[i]);
    }
    link_.send_control(protocol::encode(done));
  }

  PeerError broken_promise(const msg::Packet& packet) const {
    const std::string publisher = packet.topic.substr(0, packet.topic.find('/'));
    return broken_message(
        publisher, packet.topic, packet.envelope.seq,
        fmt::format("t_sim: {} ns is before the `next` of an earlier DONE", packet.envelope.t_sim_ns));
  }

  int refused(const std::string& text) {
    for (const std::string& problem : protocol::read_problems(text))
      log::line(ports_.process(), SimTime{0}, "refused", problem);
    return kExitUserError;
  }

  int end(int code) {
    if (code == 0) node_.finish_run();
    link_.send_control(R"({"kind":"bye"})");
    return node_.exit_code();
  }

  Ports& ports_;
  AnyNode& node_;
  Declaration declaration_;
  Stepper stepper_;
  bus::Link link_;
  std::uint32_t epoch_ = 0;
  std::chrono::milliseconds patience_{0};
  bool granted_ = false;
};

}  // namespace

int participate(const std::string& component, Ports& ports, AnyNode& node, const Meeting& meeting) {
  Participant participant(component, ports, node, meeting);
  std::optional<Termination> termination;
  if (node.completes_files()) termination.emplace([&] { participant.interrupt(); });
  try {
    return participant.run();
  } catch (const std::exception& e) {
    if (termination && termination->asked()) return kExitInterrupted;  // files are completed as the node goes
    const auto* known = dynamic_cast<const ExitError*>(&e);
    const auto* peer = dynamic_cast<const PeerError*>(&e);
    participant.report_failed({known ? known->code : kExitDied, e.what(), peer ? peer->culprit : ""});
    throw;
  }
}

}  // namespace ensonify
