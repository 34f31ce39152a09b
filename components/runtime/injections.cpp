#include "components/runtime/injections.h"

#include <fmt/format.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "components/errors/exit_error.h"

namespace ensonify {
namespace {

using nlohmann::json;

constexpr const char* kKinds[] = {"mute", "drop", "delay", "corrupt", "kill", "pause"};

Injection::Kind kind_of(const std::string& word) {
  const auto at = std::ranges::find(kKinds, word);
  if (at == std::end(kKinds)) throw std::invalid_argument("inject: there is no kind " + word);
  return static_cast<Injection::Kind>(at - std::begin(kKinds));
}

/// Even in [0, 1): of the seed, a text and a number [Steele2014].
double draw(std::uint64_t seed, const std::string& text, std::uint64_t number) {
  std::uint64_t z = seed;
  const auto take = [&z](std::uint64_t next) {
    z += 0x9e3779b97f4a7c15ULL + next;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
  };
  for (const char c : text) take(static_cast<unsigned char>(c));
  take(number);
  return 0x1p-53 * static_cast<double>(z >> 11);
}

msg::Value value_of(const std::string& text, const msg::Value& like) {
  double number = 0.0;
  if (like.as<std::string>() != nullptr) return {text};
  if (text == "true" || text == "false") return {text == "true"};
  char* end = nullptr;
  number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') return {text};
  if (like.as<std::int64_t>() != nullptr && number == std::floor(number)) return {static_cast<std::int64_t>(number)};
  return {number};
}

/// Puts a value under a path such as "position_enu_m.2"; false where there is nothing.
bool put(msg::Value& root, const std::string& path, const std::string& text) {
  const auto* found = root.at(path);
  if (found == nullptr || found->as<msg::RawArray>() != nullptr) return false;
  *const_cast<msg::Value*>(found) = value_of(text, *found);  // of our own copy
  return true;
}

/// Stops this process as SIGSTOP does; a child lets it go on.
void pause_for(double wall_s) {
  const pid_t self = ::getpid();
  const timespec time{static_cast<time_t>(wall_s), static_cast<long>(1e9 * (wall_s - std::floor(wall_s)))};
  const pid_t child = ::fork();
  if (child == 0) {
    ::nanosleep(&time, nullptr);
    ::kill(self, SIGCONT);
    ::_exit(0);
  }
  if (child > 0) ::raise(SIGSTOP);
}

}  // namespace

bool Injection::hits(const std::string& process, const std::string& port) const {
  if (kind == Kind::kKill || kind == Kind::kPause) return false;
  return target == process + "/" + port || (target == process && port != "health");
}

std::vector<Injection> injections_of(const std::string& fact) {
  std::vector<Injection> all;
  if (fact.empty()) return all;
  try {
    for (const json& one : json::parse(fact)) {
      Injection injection;
      injection.kind = kind_of(one.at("kind"));
      injection.target = one.at("target");
      injection.from = SimTime(one.at("from_ns").get<std::int64_t>());
      if (one.contains("to_ns")) injection.to = SimTime(one.at("to_ns").get<std::int64_t>());
      injection.share = one.value("share", 1.0);
      injection.by = SimTime(one.value("by_ns", std::int64_t{0}));
      injection.field = one.value("field", "");
      injection.value = one.value("value", "");
      injection.signal = one.value("signal", SIGKILL);
      injection.wall_s = one.value("wall_s", 0.0);
      all.push_back(std::move(injection));
    }
  } catch (const json::exception& error) {
    throw std::invalid_argument(std::string("inject: is not what a launch says: ") + error.what());
  }
  return all;
}

std::string fact_of(const std::vector<Injection>& injections) {
  if (injections.empty()) return "";
  json all = json::array();
  for (const Injection& one : injections) {
    json map = {
        {"kind", kKinds[static_cast<std::size_t>(one.kind)]}, {"target", one.target}, {"from_ns", one.from.count()}};
    if (one.to.count() != std::numeric_limits<SimTime::rep>::max()) map["to_ns"] = one.to.count();
    if (one.kind == Injection::Kind::kDrop) map["share"] = one.share;
    if (one.kind == Injection::Kind::kDelay) map["by_ns"] = one.by.count();
    if (one.kind == Injection::Kind::kCorrupt) map["field"] = one.field, map["value"] = one.value;
    if (one.kind == Injection::Kind::kKill) map["signal"] = one.signal;
    if (one.kind == Injection::Kind::kPause) map["wall_s"] = one.wall_s;
    all.push_back(std::move(map));
  }
  return all.dump();
}

Injector::Injector(std::vector<Injection> all, std::string process, std::vector<std::string> ports, std::uint64_t seed,
                   Say say)
    : all_(std::move(all)),
      said_(all_.size()),
      process_(std::move(process)),
      names_(std::move(ports)),
      ports_(names_.size()),
      seed_(seed),
      say_(std::move(say)) {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const bool of_process = all_[i].kind == Injection::Kind::kKill || all_[i].kind == Injection::Kind::kPause;
    if (of_process && all_[i].target == process_) of_process_.push_back(i);
    for (std::size_t p = 0; p < names_.size(); ++p) {
      if (all_[i].hits(process_, names_[p])) ports_[p].injections.push_back(i);
    }
  }
}

void Injector::say_once(std::size_t injection, const std::string& what) {
  if (!said_[injection]) say_(what);
  said_[injection] = true;
}

void Injector::begin_event(SimTime now, const Publish& publish) {
  for (const std::size_t i : of_process_) {
    const Injection& one = all_[i];
    if (now < one.from || said_[i]) continue;
    if (one.kind == Injection::Kind::kKill) {
      say_once(i, fmt::format("kill signal={}", one.signal));
      throw InjectedKill{one.signal};
    } else {
      say_once(i, fmt::format("pause wall_s={:g}", one.wall_s));
      pause_for(one.wall_s);
    }
  }
  for (std::size_t p = 0; p < ports_.size(); ++p) {
    std::deque<Late>& late = ports_[p].late;
    for (; !late.empty() && late.front().due <= now; late.pop_front())
      publish(p, std::move(late.front().body), std::move(late.front().wall_facts));
  }
}

void Injector::pass(SimTime now, std::size_t port, msg::Body body, msg::Buffer wall_facts, const Publish& publish) {
  if (port >= ports_.size() || ports_[port].injections.empty())
    return publish(port, std::move(body), std::move(wall_facts));
  Port& own = ports_[port];
  const std::string topic = process_ + "/" + names_[port];
  const std::uint64_t number = own.passed++;
  SimTime due = now;
  for (const std::size_t i : own.injections) {
    const Injection& one = all_[i];
    if (now < one.from || now >= one.to) continue;
    if (one.kind == Injection::Kind::kMute) return say_once(i, "mute topic=" + topic);
    if (one.kind == Injection::Kind::kDrop && draw(seed_, topic, number) < one.share)
      return say_once(i, fmt::format("drop topic={} share={:g}", topic, one.share));
    if (one.kind == Injection::Kind::kDelay) {
      say_once(i, fmt::format("delay topic={} by_ms={:g}", topic, 1e-6 * static_cast<double>(one.by.count())));
      due += one.by;
    }
    if (one.kind == Injection::Kind::kCorrupt) {
      msg::Value value = msg::decode_value(body, body.size());
      if (!put(value, one.field, one.value))
        throw UserError(fmt::format("inject: corrupt: {} has no value {} that is no array", topic, one.field));
      say_once(i, fmt::format("corrupt topic={} field={} value={}", topic, one.field, one.value));
      body = msg::encode_value(value);
    }
  }
  if (!own.late.empty()) due = std::max(due, own.late.back().due);  // none overtakes
  if (due <= now) return publish(port, std::move(body), std::move(wall_facts));
  own.late.push_back({due, std::move(body), std::move(wall_facts)});
}

}  // namespace ensonify
