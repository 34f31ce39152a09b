#include "components/runtime/member.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "components/errors/exit_error.h"
#include "components/runtime/injections.h"
#include "components/runtime/log.h"
#include "components/runtime/peer.h"

namespace ensonify {

Member::Member(const OpenSession& open, const Meeting& meeting, Say say, Neighbours* neighbours)
    : open_(open),
      session_(open({})),
      name_(session_->ports().process()),
      link_(name_, meeting.clock_endpoint, meeting.address, queue_length(session_->declaration(), kLongestWindow)),
      say_(say ? std::move(say) : [this](std::string_view text) { link_.send_control(text); }),
      neighbours_(neighbours) {}

void Member::say_hello() {
  protocol::Hello hello;
  hello.declaration = session_->declaration();
  hello.pid = getpid();
  hello.epoch = epoch_;
  hello.resets = true;
  hello.sync_endpoint = link_.sync_endpoint();
  hello.live_endpoint = link_.live_endpoint();
  say_(protocol::encode(hello));
}

void Member::say_proven(const std::vector<std::string>& tokens) { say_(protocol::encode_proven(tokens)); }

void Member::say_failed(const protocol::Failed& failed) { say_(protocol::encode_failed(failed)); }

void Member::take(const std::string& word) {
  if (auto grant = protocol::read_grant(word)) {
    if (grant->epoch != epoch_) return;
    std::erase_if(grant->inputs, [&](const auto& input) { return handed_over_.contains(input.first); });
    grant_ = std::move(grant);
    waited_ = std::chrono::milliseconds(0);
    has_run_ = true;
    return;
  }
  const std::string kind = protocol::kind_of(word);
  if (kind == "late") late_ = protocol::read_late(word);
  if (kind == "lost") link_.lost(protocol::read_lost(word));
  if (kind == "welcome") welcome(word);
  if (kind == "epoch") begin(protocol::read_epoch(word));
  if (kind == "refused") refused(word);
  if (kind == "end") end(protocol::read_code(word));
}

void Member::welcome(const std::string& text) {
  protocol::Welcome w = protocol::read_welcome(text, session_->ports().outs(), session_->ports().ins());
  epoch_ = w.epoch;
  patience_ = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * w.patience_s));
  std::vector<Feed> feeds;
  std::vector<bus::Subscription> of_neighbours, subscriptions;
  may_be_lost_.clear();
  handed_over_.clear();
  for (const protocol::WelcomeIn& in : w.ins) {
    const Feed& c = in.feed;
    feeds.push_back(c);
    const bool is_handed_over = neighbours_ != nullptr && neighbours_->is_one(c.publisher);
    (is_handed_over ? of_neighbours : subscriptions)
        .push_back({c.topic, c.topic_id, c.type, in.endpoint, in.token, c.max_bytes, c.publisher, c.rank, c.rate,
                    c.may_be_lost});
    if (is_handed_over) handed_over_.insert(c.topic_id);
    if (c.may_be_lost) may_be_lost_.insert(c.topic_id);
  }
  session_->stepper().wire(std::move(feeds), std::move(w.outs), std::move(w.facts), w.epoch, w.rank,
                           [this](msg::Packet&& packet) {
                             link_.publish(packet);
                             if (neighbours_ != nullptr) neighbours_->hand_over(packet);
                           },
                           {.watched = [this](const std::string& topic) { return link_.is_watched(topic); },
                            .send = [this](msg::Packet&& packet) { link_.publish_live(packet); },
                            .late = [this] { return late_; }});
  early_.clear();
  for (const bus::Subscription& topic : of_neighbours) neighbours_->read(name(), topic);
  receives_ |= !subscriptions.empty();
  if (receives_) link_.subscribe(subscriptions, w.epoch);
  if (wired_) say_(R"({"kind":"ready"})");
  wired_ = true;
}

/// The epoch before has been run to its end. What is left of it goes before its successor comes: files and sockets
/// may be the same.
void Member::begin(const protocol::Begin& next) {
  finish();
  session_.reset();
  epoch_ = next.epoch;
  session_ = open_({next.sets, next.out});
  say_hello();
}

bool Member::run(std::chrono::milliseconds patience) {
  if (!all_is_here(patience)) return false;
  run_grant();
  return true;
}

/// Time in which this process was stopped does not count as waited for.
bool Member::all_is_here(std::chrono::milliseconds patience) {
  if (!receives_) return true;
  const auto arrived = link_.wait_arrived(grant_->inputs, patience);
  if (arrived == bus::Link::Arrived::kAll) return true;
  waited_ = arrived == bus::Link::Arrived::kSome ? std::chrono::milliseconds(0) : waited_ + patience;
  if (waited_ < patience_) return false;
  link_.refuse_missing(grant_->inputs);
  return true;
}

void Member::run_grant() {
  Stepper& stepper = session_->stepper();
  if (receives_) take_packets();
  const SimTime horizon = grant_->horizon;
  grant_.reset();
  const auto begin = std::chrono::steady_clock::now();
  protocol::Done done;
  std::optional<InjectedKill> killed;
  try {
    done.finish = stepper.run_to(horizon);
  } catch (const InjectedKill& kill) {
    killed = kill;  // the events before that one have been run
  }
  for (const auto& [at, why] : stepper.take_unusable())
    say_(protocol::encode(protocol::Unusable{at, {why.code, why.what(), why.culprit}}));
  link_.flush();
  done.cost_ns = (std::chrono::steady_clock::now() - begin).count();
  if (receives_) link_.expect_until(saturating_add(stepper.next(), kLongestWindow));
  done.epoch = epoch_;
  done.next = done.finish ? stepper.last() + SimTime{1} : stepper.next();
  for (std::size_t i = 0; i < stepper.outs().size(); ++i)
    done.outputs.emplace_back(stepper.outs()[i].topic_id, stepper.published()[i]);
  say_(protocol::encode(done));
  if (killed) throw InjectedKill(*killed);
}

void Member::take_packets() {
  Stepper& stepper = session_->stepper();
  for (const msg::Packet& packet : counted()) {
    if (stepper.too_late(packet)) refuse(packet);
    else stepper.insert(packet);
  }
  for (const bus::Unusable& topic : link_.take_unusable()) stepper.close(topic.topic_id, topic.t, topic.why);
}

/// What has come and the grant counts, in order per topic. What it does not count waits: should its publisher be lost
/// before it has counted it, nobody reads it.
std::vector<msg::Packet> Member::counted() {
  std::vector<msg::Packet> packets = std::exchange(early_, {});
  std::vector<msg::Packet> fresh = link_.take();
  packets.insert(packets.end(), std::make_move_iterator(fresh.begin()), std::make_move_iterator(fresh.end()));
  const auto is_counted = [&](const msg::Packet& packet) {
    return std::ranges::any_of(grant_->inputs, [&](const auto& input) {
      return input.first == packet.envelope.topic_id && packet.envelope.seq < input.second;
    });
  };
  const auto early = std::stable_partition(packets.begin(), packets.end(), is_counted);
  early_.assign(std::make_move_iterator(early), std::make_move_iterator(packets.end()));
  packets.erase(early, packets.end());
  return packets;
}

/// It breaks a promise.
void Member::refuse(const msg::Packet& packet) {
  const std::string publisher = packet.topic.substr(0, packet.topic.find('/'));
  const PeerError why =
      broken_message(publisher, packet.topic, packet.envelope.seq,
                     fmt::format("t_sim: {} ns is before the `next` of an earlier DONE", packet.envelope.t_sim_ns));
  if (!may_be_lost_.contains(packet.envelope.topic_id)) throw PeerError(why);
  session_->stepper().close(packet.envelope.topic_id, SimTime{packet.envelope.t_sim_ns}, why);
}

void Member::refused(const std::string& text) {
  for (const std::string& problem : protocol::read_problems(text)) log::line(name(), SimTime{0}, "refused", problem);
  exit_code_ = kExitUserError;
  over_ = true;
}

void Member::end(int code) {
  if (code == 0) finish();
  else note_exit_code();
  say_(protocol::encode_bye(exit_code_));
  over_ = true;
}

void Member::finish() {
  session_->node().finish_run();
  note_exit_code();
}

void Member::note_exit_code() {
  if (exit_code_ == kExitOk) exit_code_ = session_->node().exit_code();
}

protocol::Failed failure_of(const std::exception& e) {
  const auto* known = dynamic_cast<const ExitError*>(&e);
  const auto* peer = dynamic_cast<const PeerError*>(&e);
  return {known ? known->code : kExitDied, e.what(), peer ? peer->culprit : ""};
}

}  // namespace ensonify
