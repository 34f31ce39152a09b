#include "tools/console/viewer.h"

#include <algorithm>

#include "components/errors/exit_error.h"
#include "components/view/ping_view.h"
#include "messages/console.h"
#include "messages/value.h"
#include "tools/console/console.h"
#include "tools/console/frame.h"

namespace ensonify::console {

namespace {

constexpr const char* kStateTopic = "console/state";
constexpr const char* kFlowTopic = "console/flow";
constexpr const char* kAnswerTopic = "console/answer";
constexpr std::chrono::milliseconds kFetchEvery{250};  // of the chart and of numbers
constexpr std::string_view kCommands[] = {"pause", "resume", "rate", "stop"};

template <msg::Message M>
M read(const msg::Value& value) {
  M message;
  msg::from_value(value, message, "");
  if (const std::string field = msg::not_finite(message); !field.empty())
    throw msg::DecodeError(field + ": is no finite number");
  return message;
}

}  // namespace

Viewer::Viewer(Console& console, Line& line, WallTime now)
    : console_(console), line_(line), came_(now), flow_(now), second_(now) {}

Viewer::~Viewer() {
  if (desk_) desk_->remove(flow_);
  console_.leave(*this);
}

template <msg::Message M>
void Viewer::offer_own(const std::string& topic, const M& message, Way way) {
  msg::Packet packet{topic, {}, msg::encode(message), {}};
  packet.envelope.type_hash = msg::type_hash(M::kType);
  packet.envelope.seq = seq_++;
  flow_.offer({topic, way, std::make_shared<const msg::Packet>(std::move(packet)), std::chrono::steady_clock::now()},
              true);
}

void Viewer::said(std::string_view text) {
  const WallTime now = std::chrono::steady_clock::now();
  std::string type;
  try {
    const msg::Value value = msg::from_json(text);
    const msg::Value* named = value.find("type");
    const auto* name = named == nullptr ? nullptr : named->as<std::string>();
    if (name == nullptr) throw msg::DecodeError("a message is a JSON object with the key type");
    type = *name;
    take(type, value, now);
  } catch (const msg::DecodeError& e) {
    console_.count_refused("messages that say nothing we know");
    if (!power_) return line_.close("the first message must be console_enter/1 with a token");
    answer(type, e.what());
  } catch (const std::exception& e) {  // a run or record that cannot be opened, for one
    answer(type, e.what());
  }
  push(now);
}

void Viewer::take(const std::string& type, const msg::Value& message, WallTime now) {
  if (!power_) {
    if (type == msg::ConsoleEnter::kType) power_ = console_.doors().power_of(read<msg::ConsoleEnter>(message).token);
    if (!power_) {
      console_.count_refused("viewers without a token of this console");
      return line_.close("no token of this console: open the URL that it printed");
    }
    return sit_at(console_.first());
  }
  if (flow_.answered(now)) {
    seen_ = {};
    seen_values_ = {};
    seen_log_ = {};
    send_state();
    if (desk_) desk_->settle(flow_);
  }
  if (type == msg::ConsoleDrawn::kType) {
    const auto drawn = read<msg::ConsoleDrawn>(message);
    return flow_.drawn(drawn.topic, static_cast<std::uint64_t>(drawn.seq), now);
  }
  if (now - second_ > std::chrono::seconds(1)) {
    second_ = now;
    said_ = 0;
  }
  if (++said_ > kMostPerSecond) {
    console_.count_refused("messages beyond 50 a second");
    throw UserError("more than 50 messages in a second");
  }
  if (type == msg::ConsoleWatch::kType) {
    const auto wish = read<msg::ConsoleWatch>(message);
    const bool cells = flow_.watches(kCellsTopic), track = flow_.watches(kTrackTopic);
    const bool log = flow_.watches(kLogTopic);
    flow_.watch(wish, now);
    if (flow_.watches(kCellsTopic) && !cells) seen_.cells = 0;
    if (flow_.watches(kTrackTopic) && !track) seen_.points.clear();
    if (flow_.watches(kLogTopic) && !log) seen_log_ = {};
    const auto& values = wish.values;
    std::erase_if(seen_values_.points, [&](const auto& entry) {
      return !flow_.watches(kValuesTopic) || std::find(values.begin(), values.end(), entry.first) == values.end();
    });
    if (desk_) desk_->settle(flow_);
  } else if (type == msg::ConsoleOpen::kType) {
    sit_at(read<msg::ConsoleOpen>(message).id);
  } else if (type == msg::ConsoleCommand::kType) {
    const auto command = read<msg::ConsoleCommand>(message);
    if (power_ != Power::control) {
      console_.count_refused("commands by the URL to view");
      throw UserError("this URL is to view only; the other one that the console printed is to control");
    }
    if (std::find(std::begin(kCommands), std::end(kCommands), command.command) == std::end(kCommands))
      throw UserError("command " + command.command + "; allowed: pause, resume, rate, stop");
    if (!desk_) throw UserError("nothing is open");
    desk_->command(command);
  } else {
    throw msg::DecodeError("type " + type +
                           "; allowed: console_watch/1, console_drawn/1, console_open/1, console_command/1");
  }
}

void Viewer::sit_at(const std::string& id) {
  const std::shared_ptr<Desk> desk = id.empty() ? nullptr : console_.desk(id);
  if (desk_) desk_->remove(flow_);
  desk_ = desk;
  seen_ = {};
  seen_values_ = {};
  seen_log_ = {};
  if (desk_) {
    desk_->add(flow_);
    desk_->settle(flow_);
  }
  send_state();
}

void Viewer::send_state() {
  msg::ConsoleState state = desk_ ? desk_->state() : msg::ConsoleState{};
  state.may_control = power_ == Power::control;
  if (state.kind == "run" && state.state == "ended" && console_.exit_code()) {
    state.exit_code = *console_.exit_code();
    state.message = "the run has ended, exit code " + std::to_string(state.exit_code);
  }
  state.items = console_.items();
  state.launches = console_.launches();
  offer_own(kStateTopic, state, Way::state);
}

void Viewer::answer(const std::string& request, const std::string& error) {
  offer_own(kAnswerTopic, msg::ConsoleAnswer{request, error}, Way::state);
}

void Viewer::tick(WallTime now) {
  if (!power_) {
    if (now - came_ > kEnterWithin) {
      console_.count_refused("viewers that did not enter within 2 s");
      line_.close("no console_enter/1 within 2 s");
    }
    return;
  }
  if (now - second_ > std::chrono::seconds(1)) {
    second_ = now;
    said_ = 0;
    if (!flow_.away(now)) offer_own(kFlowTopic, flow_.report(now), Way::state);
  }
  if (now - fetched_ > kFetchEvery) {
    fetched_ = now;
    fetch_news();
  }
  flow_.passed(now, !busy_ && line_.in_link() == 0);
  push(now);
}

/// What is new of the chart and of numbers to this viewer, once it has been sent what was new before.
void Viewer::fetch_news() {
  if (!desk_ || flow_.away(std::chrono::steady_clock::now())) return;
  if (flow_.watches(kCellsTopic) && !flow_.has_waiting(kCellsTopic))
    if (const auto cells = desk_->survey().new_cells(seen_)) offer_own(kCellsTopic, *cells, Way::line);
  if (flow_.watches(kTrackTopic) && !flow_.has_waiting(kTrackTopic))
    for (const msg::ConsoleTrack& track : desk_->survey().new_tracks(seen_)) offer_own(kTrackTopic, track, Way::line);
  if (flow_.watches(kValuesTopic) && !flow_.has_waiting(kValuesTopic))
    if (const auto news = desk_->values().news(flow_.values(), seen_values_)) offer_own(kValuesTopic, *news, Way::line);
  if (flow_.watches(kLogTopic) && !flow_.has_waiting(kLogTopic))
    if (const auto log = desk_->logs().news(seen_log_)) offer_own(kLogTopic, *log, Way::line);
}

void Viewer::push(WallTime now) {
  while (!busy_ && power_) {
    const auto sending = flow_.next(now, line_.in_link());
    if (!sending) return;
    try {
      const auto parts = frame_of(desk_ ? desk_->message_of(*sending) : *sending->offer.packet);
      flow_.sent(size_of(parts));
      busy_ = true;
      line_.send(parts);
    } catch (const NoPicture& e) {
      flow_.drawn(sending->offer.topic, sending->offer.packet->envelope.seq, now);
      answer(sending->offer.topic, e.what());
    } catch (const msg::DecodeError& e) {
      flow_.drawn(sending->offer.topic, sending->offer.packet->envelope.seq, now);
      answer(sending->offer.topic, e.what());
    }
  }
}

void Viewer::sent() {
  busy_ = false;
  push(std::chrono::steady_clock::now());
}

}  // namespace ensonify::console
