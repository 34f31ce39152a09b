#include "components/runtime/protocol.h"

#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace ensonify::protocol {

namespace {

using nlohmann::json;

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
                  {"topics", p.topics}});
  }
  return {{"name", d.process}, {"component", d.component}, {"may_finish", d.may_finish}, {"out", out},
          {"in", in},          {"notes", d.notes}};
}

Declaration from_json(const json& j) {
  Declaration d;
  d.process = j.at("name");
  d.component = j.value("component", "");
  d.may_finish = j.value("may_finish", false);
  d.notes = j.value("notes", std::map<std::string, double>{});
  for (const json& p : j.at("out")) {
    OutPort out{p.at("port"), p.at("type"), p.value("max_bytes", std::size_t{4096}), {}};
    if (p.contains("rate")) out.rate = {p.at("rate").at(0), p.at("rate").at(1)};
    if (out.rate.num < 0 || out.rate.den <= 0) throw std::runtime_error(out.port + ": rate is not a positive fraction");
    d.outs.push_back(out);
  }
  for (const json& p : j.at("in")) {
    d.ins.push_back({p.at("port"), p.at("type"), SimTime{p.value("delay_ns", std::int64_t{0})},
                     p.value("optional", false), p.value("topics", std::vector<std::string>{}), 0});
  }
  return d;
}

json parse(std::string_view text) {
  json j = json::parse(text, nullptr, false);
  if (j.is_discarded() || !j.is_object()) throw std::runtime_error("control message is not a JSON object");
  return j;
}

template <class T>
void put(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Reads little-endian numbers from the front; remembers when there were too few bytes.
struct Cursor {
  std::string_view rest;
  bool good = true;

  template <class T>
  T get() {
    T value{};
    if (rest.size() < sizeof value) return good = false, value;
    std::memcpy(&value, rest.data(), sizeof value);
    rest.remove_prefix(sizeof value);
    return value;
  }
  TopicCounts counts() {
    const auto n = get<std::uint32_t>();
    TopicCounts counts;
    for (std::uint32_t i = 0; i < n && good; ++i) {
      const auto topic = get<std::uint32_t>();
      counts.emplace_back(topic, get<std::uint64_t>());
    }
    return counts;
  }
};

void put_counts(std::string& to, const TopicCounts& counts) {
  put(to, static_cast<std::uint32_t>(counts.size()));
  for (const auto& [topic, count] : counts) {
    put(to, topic);
    put(to, count);
  }
}

}  // namespace

std::string declaration_json(const Declaration& declaration) { return to_json(declaration).dump(); }
Declaration read_declaration(std::string_view text) { return from_json(parse(text)); }

std::string encode(const Hello& hello) {
  json j = to_json(hello.declaration);
  j["kind"] = "hello";
  j["pid"] = hello.pid;
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
  hello.pid = j.value("pid", std::int64_t{0});
  hello.first = SimTime{j.value("first_ns", std::int64_t{0})};
  hello.sync_endpoint = j.at("sync");
  hello.live_endpoint = j.at("live");
  hello.facts = j.value("facts", std::map<std::string, std::string>{});
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
                  {"endpoint", i.endpoint},
                  {"token", i.token}});
  }
  return json{{"kind", "welcome"}, {"epoch", w.epoch}, {"rank", w.rank}, {"out", out}, {"in", in}, {"facts", w.facts}}
      .dump();
}

Welcome read_welcome(std::string_view text, const std::vector<OutPort>& outs, const std::vector<InPort>& ins) {
  const json j = parse(text);
  Welcome w;
  w.epoch = j.at("epoch");
  w.rank = j.at("rank");
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
    in.endpoint = i.at("endpoint");
    in.token = i.at("token");
    w.ins.push_back(std::move(in));
  }
  return w;
}

std::string encode(const Grant& grant) {
  std::string bytes = "G";
  put(bytes, grant.epoch);
  put(bytes, static_cast<std::int64_t>(grant.horizon.count()));
  put_counts(bytes, grant.inputs);
  return bytes;
}

std::optional<Grant> read_grant(std::string_view bytes) {
  if (bytes.empty() || bytes[0] != 'G') return std::nullopt;
  Cursor cursor{bytes.substr(1)};
  Grant grant;
  grant.epoch = cursor.get<std::uint32_t>();
  grant.horizon = SimTime{cursor.get<std::int64_t>()};
  grant.inputs = cursor.counts();
  if (!cursor.good || !cursor.rest.empty()) return std::nullopt;
  return grant;
}

std::string encode(const Done& done) {
  std::string bytes = "D";
  put(bytes, done.epoch);
  put(bytes, static_cast<std::int64_t>(done.next.count()));
  put(bytes, static_cast<std::uint8_t>(done.finish ? 1 : 0));
  put(bytes, done.cost_ns);
  put_counts(bytes, done.outputs);
  return bytes;
}

std::optional<Done> read_done(std::string_view bytes) {
  if (bytes.empty() || bytes[0] != 'D') return std::nullopt;
  Cursor cursor{bytes.substr(1)};
  Done done;
  done.epoch = cursor.get<std::uint32_t>();
  done.next = SimTime{cursor.get<std::int64_t>()};
  done.finish = (cursor.get<std::uint8_t>() & 1) != 0;
  done.cost_ns = cursor.get<std::int64_t>();
  done.outputs = cursor.counts();
  if (!cursor.good || !cursor.rest.empty()) return std::nullopt;
  return done;
}

std::string kind_of(std::string_view text) {
  if (text.starts_with('G')) return "grant";
  if (text.starts_with('D')) return "done";
  const json j = json::parse(text, nullptr, false);
  if (!j.is_object() || !j.contains("kind") || !j["kind"].is_string()) return "";
  return j["kind"];
}

std::string encode_failed(int code, const std::string& message) {
  return json{{"kind", "failed"}, {"code", code}, {"message", message}}.dump(-1, ' ', false,
                                                                             json::error_handler_t::replace);
}
std::string encode_proven(const std::vector<std::string>& tokens) {
  return json{{"kind", "proven"}, {"tokens", tokens}}.dump();
}
std::vector<std::string> read_tokens(std::string_view text) { return parse(text).at("tokens"); }
std::vector<std::string> read_problems(std::string_view text) { return parse(text).at("problems"); }
std::string read_message(std::string_view text) { return parse(text).value("message", ""); }
std::string encode_refused(const std::vector<std::string>& problems) {
  return json{{"kind", "refused"}, {"problems", problems}}.dump(-1, ' ', false, json::error_handler_t::replace);
}
int read_code(std::string_view text) { return parse(text).value("code", 0); }

}  // namespace ensonify::protocol
