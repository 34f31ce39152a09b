#include "components/runtime/lockstep/conductor.h"

#include <algorithm>

#include "components/errors/assert.h"
#include "components/runtime/ports.h"

namespace ensonify {

namespace {
constexpr SimTime kTick{1};
}  // namespace

Conductor::Conductor(std::size_t participants, std::vector<Edge> edges, std::vector<bool> may_finish, SimTime window)
    : edges_(std::move(edges)), may_finish_(std::move(may_finish)), window_(window), state_(participants) {
  ENSONIFY_ASSERT(may_finish_.size() == participants, "one may_finish for each participant");
}

void Conductor::end_at(SimTime end) {
  for (const State& s : state_) end = std::max(end, s.granted);
  end_ = std::min(end_, end);
}

void Conductor::stop_before(std::size_t p, SimTime t) {
  State& s = state_[p];
  s.stop = std::min(s.stop, std::max(t, saturating_add(s.granted, kTick)));
}

bool Conductor::stopped(std::size_t p) const { return !state_[p].running && state_[p].next >= state_[p].stop; }

void Conductor::end_now() { end_at(SimTime{0}); }

SimTime Conductor::uncapped_horizon(std::size_t p) const {
  SimTime horizon = end_;
  if (state_[p].stop != kNever) horizon = std::min(horizon, state_[p].stop - kTick);
  for (const Edge& edge : edges_) {
    if (edge.to == p) horizon = std::min(horizon, saturating_add(state_[edge.from].next, edge.delay) - kTick);
    if (edge.from == p) horizon = std::min(horizon, saturating_add(state_[edge.to].next, window_));
  }
  for (std::size_t f = 0; f < state_.size(); ++f) {
    if (may_finish_[f]) horizon = std::min(horizon, saturating_add(state_[f].next, kFinishMargin));
  }
  return horizon;
}

std::vector<Conductor::Grant> Conductor::grants() {
  std::vector<Grant> granted;
  for (std::size_t p = 0; p < state_.size(); ++p) {
    State& s = state_[p];
    if (s.running || s.next == kNever) continue;  // nothing is due any more
    const SimTime horizon = std::min(uncapped_horizon(p), cap_);
    if (horizon < s.next) continue;
    s.running = true;
    s.granted = std::max(s.granted, horizon);
    granted.push_back({p, horizon});
  }
  return granted;
}

void Conductor::done(std::size_t p, SimTime next) {
  ENSONIFY_ASSERT(next >= state_[p].next, "a promise was taken back: " + std::to_string(next.count()) + " ns after " +
                                              std::to_string(state_[p].next.count()) + " ns");
  state_[p].next = next;
  state_[p].running = false;
}

bool Conductor::finished() const {
  return std::all_of(state_.begin(), state_.end(), [&](const State& s) { return !s.running && s.next > end_; }) ||
         std::all_of(state_.begin(), state_.end(), [](const State& s) { return !s.running && s.next == kNever; });
}

bool Conductor::busy() const {
  return std::any_of(state_.begin(), state_.end(), [](const State& s) { return s.running; });
}

SimTime Conductor::now() const {
  SimTime earliest = kNever;
  for (const State& s : state_) earliest = std::min(earliest, s.next);
  return earliest;
}

SimTime Conductor::next_capped() const {
  SimTime earliest = kNever;
  for (std::size_t p = 0; p < state_.size(); ++p) {
    const State& s = state_[p];
    if (!s.running && s.next > cap_ && uncapped_horizon(p) >= s.next) earliest = std::min(earliest, s.next);
  }
  return earliest;
}

std::vector<std::size_t> Conductor::waits_for(std::size_t p) const {
  std::vector<std::size_t> blockers;
  const auto add = [&](std::size_t q) {
    if (q != p && std::find(blockers.begin(), blockers.end(), q) == blockers.end()) blockers.push_back(q);
  };
  for (const Edge& edge : edges_) {
    if (edge.to == p && saturating_add(state_[edge.from].next, edge.delay) - kTick < state_[p].next) add(edge.from);
    if (edge.from == p && saturating_add(state_[edge.to].next, window_) < state_[p].next) add(edge.to);
  }
  for (std::size_t f = 0; f < state_.size(); ++f) {
    if (may_finish_[f] && saturating_add(state_[f].next, kFinishMargin) < state_[p].next) add(f);
  }
  return blockers;
}

}  // namespace ensonify
