// What anybody may ask of the clock, and have it do.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "components/clock/clock.h"
#include "components/runtime/log.h"

namespace ensonify::clock {

namespace {

using nlohmann::json;
using std::chrono::steady_clock;

// As launch files have them.
constexpr double kSlowest = 1e-3;
constexpr double kFastest = 1e6;
constexpr SimTime kLongestStep = std::chrono::seconds(10'000'000);

}  // namespace

/// A tool's mistake is answered, and costs nobody anything.
void Clock::refuse(const std::string& to, const std::string& kind, const std::string& why) {
  control_.send(to, nlohmann::json{{"kind", kind}, {"ok", false}, {"error", why}}.dump());
}

void Clock::on_request(const bus::ControlPlane::Message& message, const std::string& kind) {
  const std::string& from = message.from;
  if (kind == "status") return void(control_.send(from, status_json()));
  if (kind == "registry") return void(control_.send(from, registry_json()));
  const json request = json::parse(message.text, nullptr, false);
  json answer = {{"kind", kind}, {"ok", true}};
  const bool steers = kind != "get";
  const std::string problem = steers ? steer(kind, request, answer) : look_up(request, answer);
  if (steers && problem.empty()) {
    const std::string tool = message.address.empty() ? "a tool" : "a tool at " + message.address;
    log::line("clock", epoch_.conductor ? std::min(epoch_.conductor->now(), epoch_.conductor->end()) : SimTime{0}, kind,
              fmt::format("asked_by=\"{}\"", registry_.rank_of(from) ? from : tool));
  }
  if (problem.empty()) control_.send(from, answer.dump(-1, ' ', false, json::error_handler_t::replace));
  else refuse(from, kind, problem);
}

std::string Clock::look_up(const json& request, json& answer) const {
  const auto& facts = registry_.facts();
  if (!request.contains("what")) {
    answer["facts"] = json::array();
    for (const auto& fact : facts) answer["facts"].push_back(fact.first);
    return "";
  }
  if (!request["what"].is_string()) return "what: is not text";
  const auto found = facts.find(request["what"]);
  if (found == facts.end()) return "no such fact";
  answer["what"] = found->first;
  answer["text"] = found->second;
  return "";
}

std::string Clock::steer(const std::string& kind, const json& request, json& answer) {
  const WallTime now = steady_clock::now();
  const SimTime reached = epoch_.conductor ? std::min(epoch_.conductor->now(), epoch_.conductor->end()) : SimTime{0};
  if (kind == "pause") {
    pacer_.pause(reached, now);
  } else if (kind == "resume") {
    pacer_.resume(now);
  } else if (kind == "step") {
    const json ns = request.value("ns", json());
    if (!ns.is_number_integer() || ns < 1 || ns > kLongestStep.count())
      return fmt::format("ns: is not an integer in [1, {}]", kLongestStep.count());
    const SimTime stepped_to = pacer_.paused() ? pacer_.cap(now) : SimTime{-1};
    const SimTime from_here = stepped_to >= SimTime{0} ? stepped_to : reached - SimTime{1};
    const SimTime step{ns.get<std::int64_t>()};
    const SimTime until = saturating_add(from_here, step);
    pacer_.step_to(until, reached, now);
    answer["until_ns"] = until.count();
  } else if (kind == "rate") {
    const json rate = request.value("rate", json());
    const bool paced = rate.is_number() && rate >= kSlowest && rate <= kFastest;
    if (!paced && !(rate.is_number() && rate == 0))
      return fmt::format("rate: is neither 0 (free) nor a number in [{:g}, {:g}]", kSlowest, kFastest);
    pacer_.set_rate(paced ? std::optional(rate.get<double>()) : std::nullopt, reached, now);
  } else if (kind == "reset") {
    return ask_reset(request, answer);
  } else if (kind == "lose") {
    return ask_to_lose(request, answer);
  } else if (kind == "stop") {
    request_stop();
  } else {
    return "unknown request; known: status, registry, get, pause, resume, step (ns), rate (0: free), reset (set, out), "
           "lose (process, why), stop";
  }
  return "";
}

}  // namespace ensonify::clock
