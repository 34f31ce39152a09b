#include "components/expect/node.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/log.h"

namespace ensonify {
namespace {

constexpr Rate kEventRate{10, 1};  // checks see every message with its own time; the rate only bounds what waits

}  // namespace

ExpectNode::ExpectNode(const Config& config, Ports& ports) : ports_(ports), events_(kEventRate) {
  std::vector<std::string> topics;
  for (const Expectation& expectation : config.expectations) {
    watches_.push_back({expectation, expect::make_check(expectation)});
    for (const std::string& topic : watches_.back().check->topics()) {
      auto& checks = by_topic_[topic];
      if (checks.empty()) topics.push_back(topic);
      if (checks.empty() || checks.back() != watches_.back().check.get()) checks.push_back(watches_.back().check.get());
    }
  }
  ports.in_any("topics", topics, [this](const msg::Packet& packet) {
    const expect::Observation message(packet);
    for (expect::Check* check : by_topic_.at(packet.topic)) check->see(message);
  });
}

/// The wiring is known now, so a misspelt field can be reported before it passes for one that never appeared.
void ExpectNode::check_fields() const {
  std::vector<ConfigProblem> problems;
  for (const Feed& feed : ports_.feeds()) {
    const msg::TypeInfo* type = msg::find_type(feed.type);
    if (!type) continue;  // of a foreign program: its messages will show
    for (const Watch& watch : watches_) {
      for (const auto& field : watch.check->fields()) {
        if (field.topic != feed.topic) continue;
        const std::string fault = expect::path_fault(*type, field.path);
        if (!fault.empty()) problems.push_back({field.place, field.path, fmt::format("{} ({})", fault, feed.type)});
      }
    }
  }
  if (!problems.empty()) throw ConfigError(problems);
}

SimTime ExpectNode::step(SimTime now) {
  if (!fields_checked_) check_fields();
  fields_checked_ = true;
  events_.due(now);
  return events_.next();
}

void ExpectNode::finish_run() {
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  bool failed = false, differs = false;
  for (Watch& watch : watches_) {
    const expect::Verdict verdict = watch.check->close(ports_.now());
    results.push_back({{"name", watch.expectation.name},
                       {"ok", verdict.ok},
                       {"t_s", seconds(verdict.t)},
                       {"message", verdict.message}});
    if (verdict.ok) continue;
    (watch.expectation.kind == Expectation::Kind::kSameAs ? differs : failed) = true;
    log::line(ports_.process(), verdict.t, "failed",
              fmt::format("expectation=\"{}\" because=\"{}\"", watch.expectation.name, verdict.message));
  }
  exit_code_ = failed ? kExitAssertionFailed : differs ? kExitDiffer : kExitOk;
  const auto file = ports_.out_dir() / "expect.json";
  std::ofstream stream(file);
  stream << results.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
  if (!stream.flush()) throw DataLost(file.string() + ": cannot be written");
}

}  // namespace ensonify
