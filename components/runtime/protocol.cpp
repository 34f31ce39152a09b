#include "components/runtime/protocol.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

#include "components/errors/exit_error.h"
#include "messages/schema.h"

namespace ensonify::protocol {

namespace {

using json = nlohmann::ordered_json;  // fields in the order of their struct

constexpr std::size_t kLongestPortName = 128;
constexpr std::size_t kMostPorts = 1000;
constexpr std::size_t kMostBytes = std::size_t{1} << 30;
constexpr std::size_t kMostDeclared = std::size_t{1} << 20;
constexpr double kHighestRateHz = 10'000.0;
constexpr SimTime kLongestDelay = std::chrono::hours(1);

json to_json(const Declaration& d) {
  json out = json::array();
  for (const OutPort& p : d.outs) {
    out.push_back({{"port", p.port}, {"type", p.type}, {"max_bytes", p.max_bytes}, {"rate", {p.rate.num, p.rate.den}}});
  }
  json in = json::array();
  for (const InPort& p : d.ins) {
    in.push_back({{"port", p.port},
                  {"type", p.type},
                  {"delay_ns", p.delay.count()},
                  {"optional", p.optional},
                  {"topics", p.topics},
                  {"least_rate", {p.least.num, p.least.den}}});
  }
  json live_only = json::array();
  for (const LivePort& p : d.lives)
    live_only.push_back({{"port", p.port}, {"type", p.type}, {"max_bytes", p.max_bytes}});
  json declares = json::object();
  for (const auto& [type, content] : d.declares) declares[type] = json::parse(msg::to_json(content));
  json j = {{"name", d.process}, {"component", d.component}, {"may_finish", d.may_finish}, {"out", out},
            {"in", in},          {"declares", declares}};
  if (!d.lives.empty()) j["live_only"] = live_only;
  return j;
}

/// The value under `key`, of exactly the kind asked for: a number is no text and 1.5 no integer. Throws naming the key.
template <class T>
T field(const json& j, const char* key) {
  const auto found = j.find(key);
  if (found == j.end()) throw std::runtime_error(std::string(key) + ": is missing");
  const auto wrong = [&](const char* wanted) { throw std::runtime_error(std::string(key) + ": is not " + wanted); };
  if constexpr (std::is_same_v<T, bool>) {
    if (!found->is_boolean()) wrong("true or false");
  } else if constexpr (std::is_integral_v<T>) {
    if (!found->is_number_integer()) wrong("an integer");
    const bool fits = found->is_number_unsigned() ? std::in_range<T>(found->template get<std::uint64_t>())
                                                  : std::in_range<T>(found->template get<std::int64_t>());
    if (!fits) wrong("an integer in range");
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!found->is_string()) wrong("text");
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    const bool texts = found->is_array() &&
                       std::all_of(found->begin(), found->end(), [](const json& item) { return item.is_string(); });
    if (!texts) wrong("a list of texts");
  } else if constexpr (std::is_same_v<T, std::map<std::string, std::string>>) {
    const bool texts = found->is_object() &&
                       std::all_of(found->begin(), found->end(), [](const json& item) { return item.is_string(); });
    if (!texts) wrong("a map of texts");
  }
  return found->template get<T>();
}
template <class T>
T field(const json& j, const char* key, T otherwise) {
  return j.contains(key) ? field<T>(j, key) : std::move(otherwise);
}

const json& list(const json& j, const char* key) {
  const auto found = j.find(key);
  const bool maps = found != j.end() && found->is_array() &&
                    std::all_of(found->begin(), found->end(), [](const json& item) { return item.is_object(); });
  if (!maps) throw std::runtime_error(std::string(key) + ": is not a list of ports");
  return *found;
}

/// A port's name, which becomes part of topics.
std::string port_name(const json& p) {
  const auto name = field<std::string>(p, "port");
  const bool good =
      !name.empty() && name.size() <= kLongestPortName &&
      std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '/'; });
  if (!good) throw std::runtime_error("port: \"" + name + "\" is not a name of at most 128 letters, digits, _ and /");
  return name;
}

/// A rate as two integers; {0} where it is left out.
Rate rate(const json& p, const char* key) {
  const auto found = p.find(key);
  if (found == p.end()) return {};
  const json& r = *found;
  const bool pair = r.is_array() && r.size() == 2 && r[0].is_number_integer() && r[1].is_number_integer();
  const Rate rate = pair ? Rate{r[0], r[1]} : Rate{-1, 1};
  if (rate.num < 0 || rate.den <= 0 || rate.hz() > kHighestRateHz)
    throw std::runtime_error(std::string(key) + ": is not two integers, [num >= 0, den > 0], of at most 10000 Hz");
  return rate;
}

std::size_t max_bytes(const json& p) {
  const auto bytes = field<std::size_t>(p, "max_bytes", 4096);
  if (bytes > kMostBytes) throw std::runtime_error("max_bytes: is more than " + std::to_string(kMostBytes));
  return bytes;
}

OutPort out_port(const json& p) { return {port_name(p), field<std::string>(p, "type"), max_bytes(p), rate(p, "rate")}; }

LivePort live_port(const json& p, const std::vector<OutPort>& outs) {
  LivePort port{port_name(p), field<std::string>(p, "type"), max_bytes(p)};
  if (std::any_of(outs.begin(), outs.end(), [&](const OutPort& out) { return out.port == port.port; }))
    throw std::runtime_error("port: \"" + port.port + "\" is an output as well");
  return port;
}

InPort in_port(const json& p) {
  InPort in{port_name(p),
            field<std::string>(p, "type"),
            SimTime{field<std::int64_t>(p, "delay_ns", 0)},
            field<bool>(p, "optional", false),
            field<std::vector<std::string>>(p, "topics", {}),
            0,
            rate(p, "least_rate")};
  if (in.delay < SimTime{0} || in.delay > kLongestDelay)
    throw std::runtime_error("delay_ns: is outside [0, " + std::to_string(kLongestDelay.count()) + "]");
  return in;
}

std::string endpoint(const json& j, const char* key) {
  const auto text = field<std::string>(j, key);
  if (!text.starts_with("ipc://") && !text.starts_with("tcp://"))
    throw std::runtime_error(std::string(key) + ": \"" + text + "\" is no endpoint, ipc://... or tcp://...");
  return text;
}

/// Calls read(port) for each; what it throws gets the port's place.
template <class Read>
void each_port(const json& j, const char* key, const Read& read) {
  const json& ports = list(j, key);
  if (ports.size() > kMostPorts)
    throw std::runtime_error(std::string(key) + ": has more than " + std::to_string(kMostPorts) + " ports");
  for (std::size_t i = 0; i < ports.size(); ++i) {
    try {
      read(ports[i]);
    } catch (const std::exception& e) {
      throw std::runtime_error(std::string(key) + "[" + std::to_string(i) + "]." + e.what());
    }
  }
}

bool deeper_than(const json& j, std::size_t levels) {
  if (!j.is_structured()) return false;
  return levels == 0 ||
         std::any_of(j.begin(), j.end(), [=](const json& item) { return deeper_than(item, levels - 1); });
}

/// What a process declares, by type; a type of ours must be one.
std::map<std::string, msg::Value> declares(const json& j) {
  const bool maps =
      j.is_object() && std::all_of(j.begin(), j.end(), [](const json& content) { return content.is_object(); });
  if (!maps) throw std::runtime_error("declares: is not a map of maps, by message type");
  std::map<std::string, msg::Value> declares;
  for (const auto& [type, content] : j.items()) {
    if (deeper_than(content, msg::kMaxDepth))
      throw std::runtime_error("declares." + type + ": is nested deeper than " + std::to_string(msg::kMaxDepth));
    const std::string text = content.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() > kMostDeclared)
      throw std::runtime_error("declares." + type + ": is longer than " + std::to_string(kMostDeclared) + " bytes");
    const msg::Value value = msg::from_json(text);
    const std::string mistake = msg::mistake_in(type, value);
    if (!mistake.empty()) throw std::runtime_error("declares." + type + "." + mistake);
    declares.emplace(type, value);
  }
  return declares;
}

Declaration from_json(const json& j) {
  Declaration d;
  d.process = field<std::string>(j, "name");
  d.component = field<std::string>(j, "component", "");
  d.may_finish = field<bool>(j, "may_finish", false);
  if (j.contains("declares")) d.declares = declares(j["declares"]);
  each_port(j, "out", [&](const json& p) { d.outs.push_back(out_port(p)); });
  each_port(j, "in", [&](const json& p) { d.ins.push_back(in_port(p)); });
  if (j.contains("live_only"))
    each_port(j, "live_only", [&](const json& p) { d.lives.push_back(live_port(p, d.outs)); });
  return d;
}

json parse(std::string_view text) {
  json j = json::parse(text, nullptr, false);
  if (j.is_discarded() || !j.is_object()) throw std::runtime_error("control message is not a JSON object");
  return j;
}

std::string dumped(const json& j) { return j.dump(-1, ' ', false, json::error_handler_t::replace); }

json to_json(const Failed& failed, const char* kind) {
  json j{{"kind", kind}, {"code", failed.code}, {"message", failed.message}};
  if (!failed.culprit.empty()) j["culprit"] = failed.culprit;
  return j;
}

Failed failed_in(const json& j) {
  Failed failed{field<int>(j, "code"), field<std::string>(j, "message", ""), field<std::string>(j, "culprit", "")};
  if (failed.code < kExitUserError || failed.code > kExitDiffer)
    throw std::runtime_error("code: " + std::to_string(failed.code) + " is not an exit code of a failure, 2 to 6");
  return failed;
}

}  // namespace

std::string declaration_json(const Declaration& declaration) { return to_json(declaration).dump(); }
Declaration read_declaration(std::string_view text) { return from_json(parse(text)); }

std::string encode(const Hello& hello) {
  json j = to_json(hello.declaration);
  j["kind"] = "hello";
  j["pid"] = hello.pid;
  j["epoch"] = hello.epoch;
  j["resets"] = hello.resets;
  j["first_ns"] = hello.first.count();
  j["sync"] = hello.sync_endpoint;
  j["live"] = hello.live_endpoint;
  j["facts"] = hello.facts;
  return j.dump();
}

Hello read_hello(std::string_view text) {
  const json j = parse(text);
  Hello hello;
  hello.declaration = from_json(j);
  hello.pid = field<std::int64_t>(j, "pid", 0);
  hello.epoch = field<std::uint32_t>(j, "epoch", hello.epoch);
  hello.resets = field<bool>(j, "resets", false);
  hello.first = SimTime{field<std::int64_t>(j, "first_ns", 0)};
  hello.sync_endpoint = endpoint(j, "sync");
  hello.live_endpoint = endpoint(j, "live");
  hello.facts = field<std::map<std::string, std::string>>(j, "facts", {});
  return hello;
}

std::string encode(const Welcome& w, const Declaration& declaration) {
  json out = json::array();
  for (std::size_t i = 0; i < w.outs.size(); ++i) {
    out.push_back({{"port", declaration.outs[i].port},
                   {"topic", w.outs[i].topic},
                   {"topic_id", w.outs[i].topic_id},
                   {"tokens", w.out_tokens[i]}});
  }
  json in = json::array();
  for (const WelcomeIn& i : w.ins) {
    const Feed& c = i.feed;
    in.push_back({{"port", declaration.ins[c.in_index].port},
                  {"topic", c.topic},
                  {"topic_id", c.topic_id},
                  {"type", c.type},
                  {"publisher", c.publisher},
                  {"rank", c.rank},
                  {"delay_ns", c.delay.count()},
                  {"max_bytes", c.max_bytes},
                  {"rate", {c.rate.num, c.rate.den}},
                  {"endpoint", i.endpoint},
                  {"token", i.token}});
    if (c.may_be_lost) in.back()["may_be_lost"] = true;
  }
  return json{{"kind", "welcome"}, {"epoch", w.epoch}, {"rank", w.rank},  {"patience_s", w.patience_s},
              {"out", out},        {"in", in},         {"facts", w.facts}}
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

Welcome read_welcome(std::string_view text, const std::vector<OutPort>& outs, const std::vector<InPort>& ins) {
  const json j = parse(text);
  Welcome w;
  w.epoch = j.at("epoch");
  w.rank = j.at("rank");
  w.patience_s = j.value("patience_s", w.patience_s);
  w.facts = j.value("facts", std::map<std::string, std::string>{});
  if (j.at("out").size() != outs.size()) throw std::runtime_error("welcome: another number of outputs than declared");
  for (const json& o : j.at("out")) {
    w.outs.push_back({o.at("topic"), o.at("topic_id")});
    w.out_tokens.push_back(o.at("tokens"));
  }
  for (const json& i : j.at("in")) {
    WelcomeIn in;
    const std::string port = i.at("port");
    while (in.feed.in_index < ins.size() && ins[in.feed.in_index].port != port) ++in.feed.in_index;
    if (in.feed.in_index == ins.size()) throw std::runtime_error("welcome: no input port " + port);
    in.feed.topic = i.at("topic");
    in.feed.topic_id = i.at("topic_id");
    in.feed.type = i.at("type");
    in.feed.publisher = i.at("publisher");
    in.feed.rank = i.at("rank");
    in.feed.delay = SimTime{i.at("delay_ns").get<std::int64_t>()};
    in.feed.max_bytes = i.at("max_bytes");
    in.feed.rate = {i.at("rate").at(0), i.at("rate").at(1)};
    in.feed.may_be_lost = i.value("may_be_lost", false);
    in.endpoint = i.at("endpoint");
    in.token = i.at("token");
    w.ins.push_back(std::move(in));
  }
  return w;
}

std::string encode(const Begin& begin) {
  return json{{"kind", "epoch"}, {"epoch", begin.epoch}, {"set", begin.sets}, {"out", begin.out}}.dump(
      -1, ' ', false, json::error_handler_t::replace);
}

Begin read_epoch(std::string_view text) {
  const json j = parse(text);
  return {field<std::uint32_t>(j, "epoch"), field<std::vector<std::string>>(j, "set"), field<std::string>(j, "out")};
}

std::string encode_late(bool late) { return json{{"kind", "late"}, {"late", late}}.dump(); }
bool read_late(std::string_view text) { return field<bool>(parse(text), "late"); }

std::string encode_lost(const std::string& process) { return json{{"kind", "lost"}, {"process", process}}.dump(); }
std::string read_lost(std::string_view text) { return field<std::string>(parse(text), "process"); }

std::string kind_of(std::string_view text) {
  if (text.starts_with('G')) return "grant";
  if (text.starts_with('D')) return "done";
  const json j = json::parse(text, nullptr, false);
  if (!j.is_object() || !j.contains("kind") || !j["kind"].is_string()) return "";
  return j["kind"];
}

std::string encode_failed(const Failed& failed) { return dumped(to_json(failed, "failed")); }
Failed read_failed(std::string_view text) { return failed_in(parse(text)); }
std::string encode(const Unusable& unusable) {
  json j = to_json(unusable.why, "unusable");
  j["t_ns"] = unusable.at.count();
  return dumped(j);
}
Unusable read_unusable(std::string_view text) {
  const json j = parse(text);
  return {SimTime{field<std::int64_t>(j, "t_ns")}, failed_in(j)};
}
std::string encode_proven(const std::vector<std::string>& tokens) {
  return json{{"kind", "proven"}, {"tokens", tokens}}.dump();
}
std::vector<std::string> read_tokens(std::string_view text) {
  return field<std::vector<std::string>>(parse(text), "tokens");
}
std::vector<std::string> read_problems(std::string_view text) { return parse(text).at("problems"); }
std::string encode_refused(const std::vector<std::string>& problems) {
  return json{{"kind", "refused"}, {"problems", problems}}.dump(-1, ' ', false, json::error_handler_t::replace);
}
std::string encode_bye(int code) { return json{{"kind", "bye"}, {"code", code}}.dump(); }
int read_code(std::string_view text) { return field<int>(parse(text), "code", 0); }

}  // namespace ensonify::protocol
