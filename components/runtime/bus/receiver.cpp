#include "components/runtime/bus/receiver.h"

#include <algorithm>
#include <set>

#include "components/errors/exit_error.h"
#include "components/runtime/bus/gate.h"
#include "components/runtime/bus/sockets.h"

namespace ensonify::bus {
namespace {
constexpr std::uint32_t kFirstEpoch = 1;
constexpr std::chrono::milliseconds kPoll{500};  // how soon it is noticed that nothing more comes of who is lost
constexpr std::chrono::seconds kAfterLoss{1};
constexpr std::size_t kLeastLargestFrame = 1 << 24;
}  // namespace

Receiver::Receiver(zmq::context_t& context, const std::vector<Subscription>& subscriptions, std::uint32_t epoch,
                   const std::optional<Keys>& keys)
    : socket_(context, zmq::socket_type::sub) {
  if (keys) set_connected(socket_, *keys);
  socket_.set(zmq::sockopt::rcvhwm, 0);  // the clock's window bounds what can arrive
  socket_.set(zmq::sockopt::rcvbuf, kKernelBuffer);
  socket_.set(zmq::sockopt::linger, 0);
  socket_.set(zmq::sockopt::reconnect_ivl, kReconnectMs);
  std::set<std::string> connected;
  std::size_t largest = kLeastLargestFrame;
  for (const Subscription& s : subscriptions) largest = std::max(largest, 2 * s.max_bytes);
  socket_.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(largest));  // a frame beyond all sense cuts the line
  begin(subscriptions, epoch);
  for (const Subscription& s : subscriptions) {
    if (connected.insert(s.endpoint).second) connect(s);
  }
  for (const Subscription& s : subscriptions) socket_.set(zmq::sockopt::subscribe, s.topic + '\0');
  for (const Subscription& s : subscriptions) socket_.set(zmq::sockopt::subscribe, "~" + s.token);
  thread_ = std::thread([this] { drain(); });
}

void Receiver::begin(const std::vector<Subscription>& subscriptions, std::uint32_t epoch) {
  const std::lock_guard lock(mutex_);
  epoch_ = epoch;
  inputs_.clear();
  for (const Subscription& s : subscriptions) inputs_.try_emplace(s.topic_id, s);
  packets_.clear();
  unusable_.clear();
  latest_ = kLongestWindow.count();
}

void Receiver::connect(const Subscription& s) {
  try {
    socket_.connect(s.endpoint);
  } catch (const zmq::error_t& e) {
    throw PeerError(kExitDied, s.publisher, s.publisher + " cannot be reached: sync: " + s.endpoint + ": " + e.what());
  }
}

void Receiver::drain() {
  try {
    std::vector<zmq::message_t> frames;
    while (receive_frames(socket_, frames)) judge(std::move(frames));
  } catch (const zmq::error_t& e) {  // also ETERM, after interrupt()
    fail(std::make_exception_ptr(DataLost(std::string("receiving: ") + e.what())));
  } catch (...) {
    fail(std::current_exception());
  }
  socket_.close();
}

/// Whose topic the message came on says whose mistake it is.
void Receiver::judge(std::vector<zmq::message_t>&& frames) {
  const std::string came_on = frames[0].to_string();
  const std::lock_guard lock(mutex_);
  try {
    msg::Packet packet = to_packet(std::move(frames));
    const auto known = inputs_.find(packet.envelope.topic_id);
    if (known == inputs_.end() || packet.topic != known->second.subscription.topic)
      throw msg::DecodeError("envelope: topic id is " + std::to_string(packet.envelope.topic_id));
    const SimTime t{packet.envelope.t_sim_ns};
    try {
      accept(known->second, std::move(packet));
    } catch (const PeerError& why) {
      refuse(known->second, why, t);
    }
  } catch (const msg::DecodeError& e) {
    for (auto& [id, input] : inputs_) {
      const Subscription& s = input.subscription;
      if (came_on.starts_with(s.topic + '\0') || came_on.starts_with("~" + s.token))
        return refuse(input, broken_message(s.publisher, s.topic, input.arrived, e.what()));
    }
    throw;
  }
}

/// The run goes on without a publisher that may be lost. Where the message gives no time that can be, it is that of the
/// one before.
void Receiver::refuse(Input& input, const PeerError& why, std::optional<SimTime> t) {
  const Subscription& s = input.subscription;
  if (!s.may_be_lost) throw PeerError(why);
  if (input.closed) return;
  input.closed = true;
  const bool known = t && *t >= input.last && *t <= SimTime{latest_.load()};
  unusable_.push_back({s.topic_id, known ? *t : input.last, why});
  if (awaited_ && all_arrived(*awaited_)) news_.notify_one();
}

void Receiver::accept(Input& input, msg::Packet&& packet) {
  if (input.closed) return;
  const Subscription& s = input.subscription;
  const msg::Envelope& e = packet.envelope;
  const auto broken = [&](const std::string& what) { throw broken_message(s.publisher, s.topic, e.seq, what); };
  if (e.epoch >= kFirstEpoch && e.epoch < epoch_) return;
  if (e.epoch != epoch_) broken("epoch: is " + std::to_string(e.epoch));
  if (e.publisher != s.rank) broken("publisher: is " + std::to_string(e.publisher));
  if (e.type_hash != msg::type_hash(s.type)) broken("type hash: is not that of " + s.type);
  if (packet.body.size() > s.max_bytes)
    broken(std::to_string(packet.body.size()) + " bytes, declared at most " + std::to_string(s.max_bytes));
  const SimTime t{e.t_sim_ns};
  if (t < input.last || t > SimTime{latest_.load()})
    broken("t_sim: " + std::to_string(e.t_sim_ns) + " ns is before the message before it, or beyond what was granted");
  if (e.seq != input.arrived) throw lost_messages(s.publisher, s.topic, input.arrived, e.seq);
  if (!input.limit.take(1, t)) broken("t_sim: " + input.limit.text());
  input.last = t;
  ++input.arrived;
  if (latest_.load() != kNever.count()) packets_.push_back(std::move(packet));
  if (awaited_ && all_arrived(*awaited_)) news_.notify_one();
}

/// What was counted and has not come.
void Receiver::refuse_missing(const Link::TopicCounts& counts) {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, count] : counts) {
    const auto found = inputs_.find(id);
    if (count == 0) continue;
    if (found == inputs_.end()) throw DataLost("a message is missing");
    if (found->second.arrived >= count || found->second.closed) continue;
    const Subscription& s = found->second.subscription;
    refuse(found->second, {kExitDataLost, s.publisher,
                           s.publisher + " lost messages: " + s.topic + ": its DONE counted " + std::to_string(count) +
                               ", " + std::to_string(found->second.arrived) + " have come"});
  }
}

bool Receiver::all_arrived(const Link::TopicCounts& counts) const {
  return std::all_of(counts.begin(), counts.end(), [this](const auto& count) {
    const auto found = inputs_.find(count.first);
    return count.second == 0 ||
           (found != inputs_.end() && (found->second.arrived >= count.second || found->second.closed));
  });
}

void Receiver::lost(const std::string& publisher) {
  const std::lock_guard lock(mutex_);
  const auto until = std::chrono::steady_clock::now() + kAfterLoss;
  for (auto& [id, input] : inputs_) {
    if (input.subscription.publisher == publisher) input.awaited_until = until;
  }
}

void Receiver::close_lost(const Link::TopicCounts& counts) {
  const auto now = std::chrono::steady_clock::now();
  for (const auto& [id, count] : counts) {
    const auto found = inputs_.find(id);
    if (found == inputs_.end() || !found->second.awaited_until) continue;
    found->second.closed |= found->second.arrived < count && now >= *found->second.awaited_until;
  }
}

void Receiver::rethrow() {
  const std::lock_guard lock(mutex_);
  if (error_) std::rethrow_exception(error_);
}

void Receiver::fail(std::exception_ptr why) {
  const std::lock_guard lock(mutex_);
  error_ = std::move(why);
  news_.notify_one();
}

Link::Arrived Receiver::wait_arrived(const Link::TopicCounts& counts, std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  const auto until = std::chrono::steady_clock::now() + patience;
  const std::size_t before = packets_.size();
  awaited_ = &counts;
  while (!news_.wait_until(lock, std::min(until, std::chrono::steady_clock::now() + kPoll),
                           [&] { return error_ || all_arrived(counts); })) {
    close_lost(counts);
    if (std::chrono::steady_clock::now() >= until) break;
  }
  awaited_ = nullptr;
  if (error_) std::rethrow_exception(error_);
  if (all_arrived(counts)) return Link::Arrived::kAll;
  return packets_.size() == before ? Link::Arrived::kNothing : Link::Arrived::kSome;
}

std::vector<msg::Packet> Receiver::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(packets_, {});
}

std::vector<Unusable> Receiver::take_unusable() {
  const std::lock_guard lock(mutex_);
  return std::exchange(unusable_, {});
}

}  // namespace ensonify::bus
