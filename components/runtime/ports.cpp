#include "components/runtime/ports.h"

#include <algorithm>
#include <utility>

#include "components/errors/assert.h"
#include "components/runtime/injections.h"
#include "components/runtime/log.h"

namespace ensonify {

Ports::Ports(std::string process, std::filesystem::path out_dir)
    : process_(std::move(process)), out_dir_(std::move(out_dir)) {}

void Ports::require_new(const std::string& port) const {
  ENSONIFY_ASSERT(!publish_, process_ + "/" + port + ": ports are declared in the node's constructor");
  const auto same = [&](const auto& other) { return other.port == port; };
  ENSONIFY_ASSERT(std::none_of(outs_.begin(), outs_.end(), same) && std::none_of(lives_.begin(), lives_.end(), same),
                  "port " + port + " declared twice");
}

std::size_t Ports::declare_out(OutPort port) {
  require_new(port.port);
  outs_.push_back(std::move(port));
  return outs_.size() - 1;
}

std::size_t Ports::declare_live(LivePort port) {
  require_new(port.port);
  lives_.push_back(std::move(port));
  return lives_.size() - 1;
}

std::size_t Ports::declare_in(InPort port, PacketHandler handler) {
  ENSONIFY_ASSERT(!publish_, process_ + "/" + port.port + ": ports are declared in the node's constructor");
  for (const InPort& other : ins_) ENSONIFY_ASSERT(other.port != port.port, "port " + port.port + " declared twice");
  ins_.push_back(std::move(port));
  handlers_.push_back(std::move(handler));
  return ins_.size() - 1;
}

void Ports::seal() { health_port_ = declare_out({"health", msg::Health::kType, 1 << 16, Rate{1, 1}}); }

void Ports::connect(std::vector<Feed> feeds, std::map<std::string, std::string> facts, Publish publish,
                    LivePlane live) {
  feeds_ = std::move(feeds);
  facts_ = std::move(facts);
  publish_ = std::move(publish);
  live_ = std::move(live);
  injector_.reset();
  if (const auto fact = facts_.find(kInjectFact); fact != facts_.end() && !fact->second.empty()) {
    std::vector<std::string> names;
    for (const OutPort& port : outs_) names.push_back(port.port);
    const auto seed = facts_.find("seed");
    injector_ = std::make_shared<Injector>(
        injections_of(fact->second), process_, std::move(names), seed == facts_.end() ? 0 : std::stoull(seed->second),
        [this](const std::string& what) { log::event(*this, "inject", "{}", what); });
  }
}

void Ports::publish(std::size_t out_index, msg::Body body, msg::Buffer wall_facts) {
  const OutPort& port = outs_[out_index];
  ENSONIFY_ASSERT(publish_, process_ + "/" + port.port + ": published outside of an event");
  ENSONIFY_ASSERT(body.size() <= port.max_bytes, process_ + "/" + port.port + ": " + std::to_string(body.size()) +
                                                     " bytes, declared at most " + std::to_string(port.max_bytes));
  if (injector_) return injector_->pass(now_, out_index, std::move(body), std::move(wall_facts), publish_);
  publish_(out_index, std::move(body), std::move(wall_facts));
}

void Ports::finish() {
  ENSONIFY_ASSERT(may_finish_, process_ + ": finish() without may_finish()");
  finish_requested_ = true;
}

void Ports::count(const std::string& what, std::int64_t by) {
  counters_[what] += by;
  health_changed_ = true;
}

void Ports::health(const std::string& state, const std::string& message) {
  if (state == health_.state && message == health_.message) return;
  health_.state = state;
  health_.message = message;
  health_changed_ = true;
}

void Ports::refuse(const msg::Packet& packet, const std::string& field) {
  const std::string what = "refused_" + packet.topic + "." + field;
  const std::string text =
      fmt::format("{}: seq {}: {}: is not a finite number", packet.topic, packet.envelope.seq, field);
  if (!counters_.contains(what)) log::line(process_, now_, "refused", text);  // the first; health counts all
  count(what);
  health("degraded", text);
}

void Ports::begin_event(SimTime now) {
  now_ = now;
  finish_requested_ = false;
  if (injector_) injector_->begin_event(now, publish_);
}

void Ports::end_event() {
  constexpr SimTime kAtMostEvery = std::chrono::seconds(1);
  if (!health_changed_ || now_ < health_due_) return;
  health_due_ = now_ + kAtMostEvery;
  health_changed_ = false;
  health_.stamp_ns = now_.count();
  health_.counters.clear();
  for (const auto& [name, count] : counters_) health_.counters.push_back({name, count});
  publish(health_port_, msg::encode(health_));
}

}  // namespace ensonify
