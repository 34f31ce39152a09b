// A reset: the present epoch ends in order, and another begins in the same processes.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "components/clock/clock.h"
#include "components/runtime/log.h"
#include "launch/process/launch_wiring.h"

namespace ensonify::clock {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostSets = 1000;

/// The overrides of a request, each as --set takes it. Throws std::runtime_error.
std::vector<std::string> sets_of(const json& request) {
  const json given = request.value("set", json::array());
  if (!given.is_array() || given.size() > kMostSets)
    throw std::runtime_error(fmt::format("set: is not a list of at most {} texts KEY=VALUE", kMostSets));
  std::vector<std::string> sets;
  for (const json& each : given) {
    if (!each.is_string()) throw std::runtime_error("set: " + each.dump() + " is not text KEY=VALUE");
    sets.push_back(each.get<std::string>());
    if (sets.back().starts_with("isa="))
      throw std::runtime_error("set: " + sets.back() + ": processes keep their instructions for the whole launch");
    if (sets.back().starts_with("clock."))
      throw std::runtime_error("set: " + sets.back() +
                               ": the clock's settings hold for the whole launch; allowed: keys of the scenario and of "
                               "processes");
  }
  return sets;
}

std::vector<std::string> names_of(const Launch& launch) {
  std::vector<std::string> names;
  for (const ProcessSpec& process : launch.processes) names.push_back(process.name);
  return names;
}

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

}  // namespace

std::string Clock::ask_reset(const json& request, json& answer) {
  if (phase_ != Phase::kRunning) return "no epoch is running that could be reset";
  if (next_) return fmt::format("epoch {} is about to begin already", next_->begin.epoch);
  if (const auto fixed = registry_.fixed(); !fixed.empty())
    return joined(fixed) + ": cannot begin another epoch; only a new launch resets it";
  for (const Account& account : epoch_.accounts) {
    if (!account.doomed.empty())
      return fmt::format("{}: is about to be lost; only a new launch resets it", account.name);
    if (!account.lost.empty())
      return fmt::format("{}: was lost at t={:.3f} s; only a new launch resets it", account.name,
                         seconds(account.lost_at));
  }
  NextEpoch next;
  next.begin.epoch = epoch_.number + 1;
  try {
    next.begin.sets = sets_of(request);
    const json out = request.value("out", json(""));
    if (!out.is_string()) return "out: is not text";
    const fs::path own = fs::path(first_.options.out) / "epochs" / std::to_string(next.begin.epoch);
    next.begin.out = fs::absolute(out == "" ? own : fs::path(out.get<std::string>())).lexically_normal().string();
    next.launch = read_(options_of({next.begin.sets, next.begin.out}, first_.options));
    if (names_of(next.launch) != names_of(launch_))
      return "set: the processes would be others; only a new launch can do that";
    fs::create_directories(next.begin.out);
  } catch (const std::exception& e) {
    return e.what();
  }
  answer["epoch"] = next.begin.epoch;
  answer["out"] = next.begin.out;
  next_ = std::move(next);
  end_epoch();
  return "";
}

/// Everybody runs on to where the first of them is, whatever the pace.
void Clock::end_epoch() {
  epoch_.ending = true;
  epoch_.conductor->end_now();
}

void Clock::begin_next() {
  const WallTime now = std::chrono::steady_clock::now();
  epoch_.ended = now;
  log::line("clock", std::min(epoch_.conductor->now(), epoch_.conductor->end()), "reset",
            fmt::format("epoch={} wall_s={:.3f}", next_->begin.epoch,
                        std::chrono::duration<double>(now - epoch_.began).count()));
  write_report(epoch_.out);
  launch_ = std::move(next_->launch);
  const protocol::Begin begin = std::move(next_->begin);
  next_.reset();
  epoch_ = {};
  epoch_.number = begin.epoch;
  epoch_.out = begin.out;
  registry_.begin(launch_, begin.epoch);
  pacer_.begin_again();
  phase_ = Phase::kJoining;
  phase_began_ = now;
  send_to_all(protocol::encode(begin));
}

}  // namespace ensonify::clock
