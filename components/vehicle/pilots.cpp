#include "components/vehicle/pilots.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ensonify {
namespace {

// What lies outside is a mistake, as of degrees in the place of radians. A speed within is held to fastest_mps.
constexpr double kLargestHeading_rad = 4.0 * std::numbers::pi;
constexpr double kHighestSpeed_mps = 100.0;
constexpr double kDeepest_m = 11'000.0;

}  // namespace

std::string refusal_of(const msg::Guidance& guidance, const std::string& vehicle) {
  const double depth_m = std::isnan(guidance.depth_m) ? 0.0 : guidance.depth_m;
  if (!guidance.vehicle.empty() && guidance.vehicle != vehicle) return "for_another_vehicle";
  if (!std::isfinite(guidance.heading_grid_rad) || !std::isfinite(guidance.speed_mps) || std::isinf(depth_m)) {
    return "not_finite";
  }
  const bool in_range = std::abs(guidance.heading_grid_rad) <= kLargestHeading_rad && guidance.speed_mps >= 0.0 &&
                        guidance.speed_mps <= kHighestSpeed_mps && depth_m >= 0.0 && depth_m <= kDeepest_m;
  return in_range ? "" : "out_of_range";
}

std::string refusal_of(const msg::Actuators& order, const std::string& vehicle,
                       const motion::HydrodynamicParameters& body) {
  if (!order.vehicle.empty() && order.vehicle != vehicle) return "for_another_vehicle";
  if (order.hand_back) return "";
  if (order.propeller_rps.size() != body.propellers.size() || order.fin_rad.size() != body.fins.size())
    return "of_other_actuators";
  const auto each = [&](auto&& holds) {
    bool all = true;
    for (std::size_t i = 0; i < body.propellers.size(); ++i)
      all = all && holds(order.propeller_rps.data()[i], body.propellers[i].fastest_rps);
    for (std::size_t i = 0; i < body.fins.size(); ++i)
      all = all && holds(order.fin_rad.data()[i], body.fins[i].largest_rad);
    return all;
  };
  if (!each([](double value, double) { return std::isfinite(value); })) return "not_finite";
  constexpr double kRounding = 1e-6;  // of a limit that the agent has as a number of seven digits
  const bool in_range = each([](double value, double most) { return std::abs(value) <= most * (1.0 + kRounding); });
  return in_range ? "" : "out_of_range";
}

bool Pilots::Pilot::silent(SimTime now) const {
  return !heard_at || (keys.timeout_s && seconds(now - *heard_at) >= *keys.timeout_s);
}

bool Pilots::Pilot::may_steer(SimTime now) const {
  if (handed_back || silent(now)) return false;
  return !was_silent || (keys.returns && seconds(now - *heard_since) >= *keys.timeout_s);
}

Pilots::Pilots(const std::vector<PilotKeys>& pilots) {
  for (const PilotKeys& keys : pilots) pilots_.push_back({.keys = keys});
}

void Pilots::take(SimTime now, const std::string& name, Order order, bool hand_back) {
  const auto pilot = std::ranges::find(pilots_, name, [](const Pilot& one) { return one.keys.name; });
  if (pilot == pilots_.end()) return;
  if (pilot->silent(now)) {
    pilot->was_silent = pilot->heard_at.has_value();
    pilot->heard_since = now;
  }
  pilot->heard_at = now;
  pilot->handed_back = hand_back;
  pilot->newest = std::move(order);
}

const Pilots::Pilot* Pilots::first(SimTime now) const {
  const auto found = std::ranges::find_if(pilots_, [&](const Pilot& pilot) { return pilot.may_steer(now); });
  return found == pilots_.end() ? nullptr : &*found;
}

bool Pilots::update(SimTime now) {
  for (Pilot& pilot : pilots_) {
    if (pilot.heard_at && pilot.silent(now)) pilot.was_silent = true;
    else if (pilot.may_steer(now)) pilot.was_silent = false;
  }
  const Pilot* steers = first(now);
  std::string name = steers != nullptr ? steers->keys.name : "";
  if (name == steered_by_) return false;
  const auto before = std::ranges::find(pilots_, steered_by_, [](const Pilot& one) { return one.keys.name; });
  why_ = before == pilots_.end() || before->may_steer(now) ? "commands" : before->handed_back ? "hand_back" : "silent";
  to_stop_ = name.empty();
  steered_by_ = std::move(name);
  return true;
}

std::optional<Order> Pilots::take_command() {
  std::optional<Order> command;
  for (Pilot& pilot : pilots_) {
    std::optional<Order> newest = std::exchange(pilot.newest, std::nullopt);
    if (pilot.keys.name == steered_by_) command = newest;
  }
  if (std::exchange(to_stop_, false) && obeyed_) {
    command = Stop{};
    if (auto* guidance = std::get_if<msg::Guidance>(&*obeyed_)) {
      guidance->speed_mps = 0.0;
      command = *guidance;
    }
  }
  if (command) obeyed_ = command;
  return command;
}

}  // namespace ensonify
