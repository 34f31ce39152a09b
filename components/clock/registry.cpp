#include "components/clock/registry.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/clock/rewiring.h"
#include "components/runtime/declared.h"
#include "components/runtime/paced.h"
#include "launch/process/launch_wiring.h"

namespace ensonify::clock {

namespace {
constexpr double kPatienceInDeadlines = 5.0;  // below the ten after which whoever waits would be taken to stall
}

Registry::Registry(const Launch& launch) {
  for (const ProcessSpec& process : launch.processes) {
    if (!process.observer) names_.push_back(process.name);  // observers are no part of the run
  }
  joined_.resize(names_.size());
  epochs_.resize(names_.size());
  begin(launch, epoch_);
}

void Registry::begin(const Launch& launch, std::uint32_t epoch) {
  epoch_ = epoch;
  rules_ = wire_rules(launch);
  places_ = process_places(launch);
  facts_ = facts_of(launch);
  if (launch.clock.rate) facts_[kPacedFact] = "true";
  may_be_lost_.clear();
  for (const ProcessSpec& process : launch.processes) {
    if (process.may_be_lost) may_be_lost_.insert(process.name);
  }
  patience_s_ = kPatienceInDeadlines * launch.clock.progress_deadline_s;
  declarations_.clear();
  graph_ = {};
}

std::optional<std::size_t> Registry::rank_of(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names_.begin());
}

std::optional<std::size_t> Registry::participant(const std::string& name) const {
  const auto rank = rank_of(name);
  return rank && epochs_[*rank] > 0 ? rank : std::nullopt;
}

bool Registry::feeds(std::size_t publisher, std::size_t subscriber) const {
  return std::any_of(graph_.edges.begin(), graph_.edges.end(), [&](const Graph::Edge& edge) {
    return edge.to == subscriber && graph_.topics[edge.topic].publisher == publisher;
  });
}

std::string Registry::join(const std::string& from, const protocol::Hello& hello) {
  const std::string& name = hello.declaration.process;
  if (name != from) return "hello of " + name + " came from " + from;
  const auto rank = rank_of(name);
  if (!rank) return name + ": the launch file names no such process";
  if (joined(*rank)) return name + ": has joined already";
  if (hello.epoch != epoch_) return fmt::format("{}: joins epoch {}, the run's is {}", name, hello.epoch, epoch_);
  const bool again = epochs_[*rank] > 0;
  if (again && hello.sync_endpoint != joined_[*rank].sync_endpoint) return name + ": its sync endpoint is another";
  joined_[*rank] = hello;
  epochs_[*rank] = epoch_;
  declarations_.push_back(hello.declaration);
  facts_[kDeclarationsFact] = declarations_json(declarations_);
  for (const auto& [key, text] : hello.facts) facts_[name + "/" + key] = text;
  return "";
}

std::vector<std::string> Registry::missing() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (!joined(i)) names.push_back(names_[i]);
  }
  return names;
}

std::vector<std::string> Registry::fixed() const {
  std::vector<std::string> names;
  for (const protocol::Hello& hello : joined_) {
    if (!hello.resets) names.push_back(hello.declaration.process);
  }
  return names;
}

const std::vector<std::string>& Registry::check() {
  declarations_.clear();  // from the order in which they joined to that of their ranks
  for (const protocol::Hello& hello : joined_) declarations_.push_back(hello.declaration);
  facts_[kDeclarationsFact] = declarations_json(declarations_);
  graph_ = wire(declarations_, rules_, places_);
  if (epoch_ == 1) {
    for (std::size_t e = 0; e < graph_.edges.size(); ++e)
      unproven_[token_of(e)] = names_[graph_.topics[graph_.edges[e].topic].publisher];
    first_ = graph_;
    first_declarations_ = declarations_;
  } else {
    for (std::size_t rank = 0; rank < names_.size(); ++rank) unready_.insert(rank);
    if (graph_.problems.empty()) graph_.problems = rewired(first_, first_declarations_, graph_, declarations_);
  }
  return graph_.problems;
}

void Registry::is_ready(std::size_t rank) { unready_.erase(rank); }

void Registry::proven(const std::string& from, const std::string& token) {
  const auto edge = unproven_.find(token);
  if (edge != unproven_.end() && edge->second == from) unproven_.erase(edge);
}

protocol::Welcome Registry::welcome(std::size_t rank) const {
  protocol::Welcome w;
  w.epoch = epoch_;
  w.rank = static_cast<std::uint32_t>(rank);
  w.facts = facts_;
  w.patience_s = patience_s_;
  for (std::size_t t = 0; t < graph_.topics.size(); ++t) {
    if (graph_.topics[t].publisher != rank) continue;
    w.outs.push_back({graph_.topics[t].name, static_cast<std::uint32_t>(t)});
    std::vector<std::string>& tokens = w.out_tokens.emplace_back();
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      if (graph_.edges[e].topic == t) tokens.push_back(token_of(e));
    }
  }
  for (Feed feed : feeds_of(graph_, declarations_, rank)) {
    feed.may_be_lost = may_be_lost_.contains(feed.publisher);
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      const Graph::Edge& edge = graph_.edges[e];
      if (edge.to != rank || edge.topic != feed.topic_id || edge.in_port != feed.in_index) continue;
      w.ins.push_back({feed, joined_[feed.rank].sync_endpoint, token_of(e)});
    }
  }
  return w;
}

std::vector<std::string> Registry::unproven() const {
  std::vector<std::string> names;
  for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
    if (!unproven_.contains(token_of(e))) continue;
    names.push_back(graph_.topics[graph_.edges[e].topic].name + " -> " + names_[graph_.edges[e].to]);
  }
  for (const std::size_t rank : unready_) names.push_back(names_[rank]);
  return names;
}

}  // namespace ensonify::clock
