#include "launch/file/injections.h"

#include <algorithm>

#include "components/errors/nearest_name.h"

namespace ensonify {
namespace {

void put(const MuteKeys& keys, Injection&) { static_cast<void>(keys); }
void put(const DropKeys& keys, Injection& to) { to.share = keys.share; }
void put(const DelayKeys& keys, Injection& to) { to.by = from_seconds(keys.by_s); }
void put(const CorruptKeys& keys, Injection& to) { to.field = keys.field, to.value = keys.value; }
void put(const KillKeys& keys, Injection& to) { to.signal = static_cast<int>(keys.signal); }
void put(const PauseKeys& keys, Injection& to) { to.wall_s = keys.for_wall_s; }

template <class Keys>
Injection injection_of(const Keys& keys) {
  Injection one;
  one.kind = Keys::kKind;
  one.target = keys.target;
  if constexpr (requires { keys.at_s; }) {
    one.from = from_seconds(keys.at_s);
  } else {
    one.from = from_seconds(keys.from_s);
    if (keys.to_s) one.to = from_seconds(*keys.to_s);
  }
  put(keys, one);
  return one;
}

bool is_of_process(const Injection& one) {
  return one.kind == Injection::Kind::kKill || one.kind == Injection::Kind::kPause;
}

std::string text_of(const ConfigPlace& place) {
  return place.line == 0 ? place.file
                         : place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

/// Why it cannot be; "" where it can.
std::string fault_of(const Injection& one, const std::vector<ProcessSpec>& processes) {
  const std::string name = one.target.substr(0, one.target.find('/'));
  const auto process = std::ranges::find(processes, name, &ProcessSpec::name);
  if (process == processes.end()) {
    std::vector<std::string> names;
    for (const ProcessSpec& each : processes) names.push_back(each.name);
    const std::string nearest = nearest_name(name, names);
    return "no process is named " + name + (nearest.empty() ? "" : "; did you mean " + nearest + "?");
  }
  if (is_of_process(one) && name != one.target) return one.target + " is an output; allowed: a process";
  if (is_of_process(one) && process->external) return name + " is external: only who starts it can end or stop it";
  if (one.to <= one.from) return "to_s is not after from_s";
  const bool ends = one.to != Injection{}.to;  // then all that is late comes at once, and ports allow a second's worth
  if (ends && one.by > std::chrono::seconds(1))
    return "by_ms is above 1000 in a delay that ends; allowed: up to 1000, or no to_s";
  return "";
}

}  // namespace

std::vector<Injection> read_injections(const ConfigReader& from, const std::vector<InjectKeys>& keys,
                                       const std::vector<ProcessSpec>& processes) {
  std::vector<Injection> all;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    Injection one = std::visit([](const auto& of) { return injection_of(of); }, keys[i].fault);
    if (one.target.empty() && !from.good()) continue;  // said already
    const std::string key = "inject[" + std::to_string(i) + "]";
    if (const std::string fault = fault_of(one, processes); !fault.empty())
      from.add(ConfigError({{keys[i].place, key, fault}}));
    one.place = text_of(keys[i].place) + ": " + key;
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<InjectKeys> keys_of(const std::vector<Injection>& injections) {
  std::vector<InjectKeys> all;
  for (const Injection& one : injections) {
    const double from_s = seconds(one.from);
    const bool ends = one.to != Injection{}.to;
    const auto to_s = ends ? std::optional(seconds(one.to)) : std::nullopt;
    InjectKeys& keys = all.emplace_back();
    switch (one.kind) {
      case Injection::Kind::kMute: keys.fault = MuteKeys{one.target, from_s, to_s}; break;
      case Injection::Kind::kDrop: keys.fault = DropKeys{one.target, one.share, from_s, to_s}; break;
      case Injection::Kind::kDelay: keys.fault = DelayKeys{one.target, seconds(one.by), from_s, to_s}; break;
      case Injection::Kind::kCorrupt: keys.fault = CorruptKeys{one.target, one.field, one.value, from_s, to_s}; break;
      case Injection::Kind::kKill:
        keys.fault = KillKeys{one.target, from_s, static_cast<KillKeys::Signal>(one.signal)};
        break;
      case Injection::Kind::kPause: keys.fault = PauseKeys{one.target, from_s, one.wall_s}; break;
    }
  }
  return all;
}

ConfigNode node_of(const std::vector<Injection>& injections) {
  return injections.empty() ? ConfigNode{} : ConfigNode::text(fact_of(injections));
}

}  // namespace ensonify
