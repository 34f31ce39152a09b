#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "components/runtime/log.h"
#include "components/runtime/paced.h"
#include "components/runtime/ports.h"
#include "components/sonar/head_config.h"
#include "components/sonar/head_inputs.h"
#include "components/sonar/ping_cycle.h"
#include "components/sonar/ping_pictures.h"
#include "components/sonar/surroundings.h"
#include "kernels/base/profile/profile.h"

namespace ensonify {

/// Axis of a head's frame from which the angles of its beams are counted, positive to starboard.
enum class BeamAxis { kDown, kForward };

std::string axis_name(BeamAxis axis);

/// Plan of a head: what follows from its parameters before the run.
struct HeadPlan {
  std::vector<HeadInputs::Channel> channels;  // that ping together, each with settings of its own
  double longest_reception_s = 0.0;           // with the longest range and pulse that can be set
  double finest_beam_rad = 0.0;
  BeamAxis beam_axis = BeamAxis::kDown;
  double near_field_m = 0.0;    // of the unfocused receive array; 0: not stated
  bool probe = false;           // for the sound speed at its face
  std::string instrument = {};  // class that it stands for; "": none in particular
};

/// Output of a channel: its port and the longest message. In a head whose channels have names the port is `port_name`.
template <msg::Message M>
struct HeadOutput {
  std::string port;
  std::size_t max_bytes = OutOptions{}.max_bytes;
  bool declared = true;
};
template <msg::Message... M>
using HeadOutputs = std::tuple<HeadOutput<M>...>;

/// A channel's part of a ping at its transmission.
struct SentPing {
  std::vector<Transmission> sectors;
  double sound_speed_mps = 0.0;  // as the head knows it
};

/// A channel's part of a ping at its publication: messages without tracks, in the order of the outputs.
template <msg::Message... M>
struct HeadReport {
  std::tuple<std::optional<M>...> messages;
  bool seabed_in_range = true;  // a ray hit it
  std::string trouble = {};     // else, for health; "" when all is well
  bool for_viewers = false;     // the ping/1 among the messages is for their picture alone
};

/// Channel that could only receive noise.
struct SilentChannel {
  std::string name;
  double range_m = 0.0;
};

HeadInputs::Start inputs_of(const HeadConfig& config, const HeadPlan& plan);
/// Declaration of a head for those that look for heads: pager, autopilot, `ensonify check`, plots. `kind` is that of
/// its pings.
msg::HeadDeclaration declaration_of(const std::string& kind, const HeadConfig& config, const HeadPlan& plan);
std::string no_seabed_reason(const std::vector<SilentChannel>& silent);

/// Node of any head: inputs, ping cycle and, for each channel, the head itself as a value with its outputs. Two kinds
/// of event: a transmission of all channels at once, at which the settings are fixed, and the end of its processing,
/// at which every pose it needs has arrived and it is computed and published.
///
/// A head gives:
///   Config, kComponent                     its HeadConfig and the name of its program
///   Head(config, channel)                  one per channel; the node keeps the configuration, so the head refers to it
/// and five functions:
///   static HeadPlan plan(config)
///   HeadOutputs<M...> outputs()
///   sent transmit(now, settings, around)   a SentPing, or a type of its own with the member `sectors`
///   Design prepare(settings)               what follows from settings alone: const, without memory
///   HeadReport<M...> ping(event, sent, around)
/// and, only if it has inputs of its own, connect(ports). It has at most two members that change: its Memory, scratch
/// whose contents do not matter, and its State, what later pings depend on, which state() gives.
template <class Head>
class HeadNode {
 public:
  using Config = typename Head::Config;
  static constexpr const char* kComponent = Head::kComponent;

  HeadNode(const Config& config, Ports& ports) : HeadNode(config, Head::plan(config), ports) {}

  SimTime step(SimTime now) {
    if (now == SimTime{0} && is_paced(ports_.facts())) rehearse();
    return cycle_.step(
        now, [&] { transmit(now); }, [this](const PingUnderWay& ping) { publish(ping); });
  }

 private:
  using Sent = decltype(std::declval<Head&>().transmit(SimTime{}, HeadSettings{}, std::declval<const Surroundings&>()));

  template <class Outputs>
  struct OutsOf;
  template <msg::Message... M>
  struct OutsOf<HeadOutputs<M...>> {
    using Type = std::tuple<std::optional<Ports::Out<M>>...>;
  };
  using Outs = typename OutsOf<decltype(std::declval<const Head&>().outputs())>::Type;

  struct Channel {
    Channel(const Config& config, std::size_t number, std::string its_name)
        : name(std::move(its_name)), head(config, number) {}

    std::string name;  // "": the only one
    Head head;
    Outs outs;
    std::optional<PingPictures> pictures = {};
    std::deque<Sent> under_way = {};
  };

  HeadNode(const Config& config, const HeadPlan& plan, Ports& ports)
      : ports_(ports),
        config_(config),
        inputs_(ports, inputs_of(config, plan)),
        cycle_(ports, inputs_, config.timing()) {
    for (const HeadInputs::Channel& planned : plan.channels) {
      Channel& channel = channels_.emplace_back(config_, channels_.size(), planned.name);
      declare(channel, plan, config.timing().rate, ports);
      if constexpr (requires { channel.head.connect(ports); }) channel.head.connect(ports);
    }
    ports.declare(declaration_of(kComponent, config, plan));
  }

  void declare(Channel& channel, const HeadPlan& plan, Rate rate, Ports& ports) {
    const auto declare = [&]<msg::Message M>(const HeadOutput<M>& output, std::optional<Ports::Out<M>>& out) {
      const std::string behind = channel.name.empty() ? "" : "_" + channel.name;
      if (output.declared) out = ports.out<M>(output.port + behind, {.max_bytes = output.max_bytes, .rate = rate});
      if constexpr (std::is_same_v<M, msg::Ping>)
        if (output.declared)
          channel.pictures.emplace(ports, "view" + behind, output.max_bytes, axis_name(plan.beam_axis));
    };
    for_pairs(channel.head.outputs(), channel.outs, declare);
  }

  /// A ping at rest that nobody receives, before sim time follows wall time. Mesh, tables and memory are made in it,
  /// which else would make the first ping late.
  void rehearse() {
    constexpr SimTime kNow{0};
    const auto body = inputs_.truth().at(kNow.count());
    if (!body || !inputs_.obstacle(kNow).empty()) return;
    const auto began = std::chrono::steady_clock::now();
    frames::PoseHistory truth(0);
    truth.push(kNow.count(), *body);
    const Surroundings around = surroundings(truth);
    for (std::size_t i = 0; i < channels_.size(); ++i) rehearse(channels_[i].head, inputs_.settings_at_ping(i), around);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    log::event(ports_, "rehearsed", "took_s={:.3f}", took.count());
  }

  static void rehearse(Head& head, const HeadSettings& settings, const Surroundings& around) {
    const auto ping = [&] {
      const Sent sent = head.transmit(SimTime{0}, settings, around);
      head.ping({0, SimTime{0}, sent.sectors.front().settings.range_m}, sent, around);
    };
    if constexpr (requires { head.state(); }) {
      const auto state = head.state();
      ping();
      head.state() = state;
    } else {
      ping();
    }
  }

  void transmit(SimTime now) {
    std::vector<Transmission> sectors;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      Channel& channel = channels_[i];
      channel.under_way.push_back(
          channel.head.transmit(now, inputs_.settings_at_ping(i), surroundings(inputs_.truth())));
      const auto& sent = channel.under_way.back().sectors;
      sectors.insert(sectors.end(), sent.begin(), sent.end());
    }
    cycle_.transmit(now, std::move(sectors));
  }

  void publish(const PingUnderWay& ping) {
    std::vector<SilentChannel> silent;
    std::string trouble;
    std::size_t sector = 0;
    for (Channel& channel : channels_) {
      const Sent sent = std::move(channel.under_way.front());
      channel.under_way.pop_front();
      PingEvent event = ping.event(sector);
      event.picture = channel.pictures && channel.pictures->wanted();
      auto report = channel.head.ping(event, sent, surroundings(inputs_.truth()));
      sector += sent.sectors.size();

      for_pairs(report.messages, channel.outs, [&]<msg::Message M>(std::optional<M>& message, auto& out) {
        if (!message || !out) return;
        if constexpr (requires { message->track; }) {
          inputs_.fill_track(message->track, ping.transmit, sent.sectors.front().reception);
        }
        if (std::is_same_v<M, msg::Ping> && report.for_viewers) return;
        const profile::Span span(profile::Stage::kMessage);
        out->send(*message);
      });
      if (event.picture) show(report.messages, *channel.pictures);
      if (!report.seabed_in_range) silent.push_back({channel.name, sent.sectors.front().settings.range_m});
      if (trouble.empty()) trouble = report.trouble;
    }
    cycle_.published(silent.empty() ? trouble : no_seabed_reason(silent));
  }

  /// The ping's picture, with the soundings of heads that have them.
  template <class Messages>
  static void show(const Messages& messages, PingPictures& pictures) {
    const msg::Ping* ping = nullptr;
    const msg::Soundings* soundings = nullptr;
    const auto note = [&]<msg::Message M>(const std::optional<M>& message) {
      if (!message) return;
      if constexpr (std::is_same_v<M, msg::Ping>) ping = &*message;
      if constexpr (std::is_same_v<M, msg::Soundings>) soundings = &*message;
    };
    std::apply([&](const auto&... all) { (note(all), ...); }, messages);
    if (ping != nullptr) pictures.show(*ping, soundings);
  }

  /// act(a, b) of the elements of two tuples, in their order.
  template <class A, class B, class Act>
  static void for_pairs(A&& a, B&& b, const Act& act) {
    [&]<std::size_t... i>(std::index_sequence<i...>) { (act(std::get<i>(a), std::get<i>(b)), ...); }
    (std::make_index_sequence<std::tuple_size_v<std::remove_cvref_t<A>>>());
  }

  Surroundings surroundings(const frames::PoseHistory& truth) const {
    return {truth,
            inputs_.seabed(),
            inputs_.estimate(),
            inputs_.navigation_errors(),
            inputs_.sound_speed_mps(),
            inputs_.probe_mps()};
  }

  Ports& ports_;
  const Config config_;  // the only one: channels refer to it
  HeadInputs inputs_;
  PingCycle cycle_;
  std::deque<Channel> channels_;
};

}  // namespace ensonify
