#include "tools/clock/status_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

namespace ensonify::clock_tool {

namespace {

using nlohmann::json;

std::string time_text(const json& t_ns) {
  return t_ns.is_number() ? fmt::format("{:.3f}", t_ns.get<double>() * 1e-9) : "never";
}

std::string names(const json& list) {
  std::string text;
  for (const json& name : list) text += (text.empty() ? "" : ", ") + name.get<std::string>();
  return text;
}

std::string run_line(const json& status) {
  const json& rate = status.at("rate");
  std::string text = status.at("state").get<std::string>();
  text += rate.is_number() ? fmt::format(", paced at {:g}x", rate.get<double>()) : ", free running";
  text += ", t=" + time_text(status.at("sim_ns")) + " s";
  if (status.at("end_ns").is_number()) text += " of " + time_text(status["end_ns"]) + " s";
  if (const int epoch = status.value("epoch", 1); epoch > 1) text += fmt::format(", epoch {}", epoch);
  text += fmt::format(", {:.1f} s wall", status.at("wall_s").get<double>());
  if (const auto slips = status.at("slips").get<std::uint64_t>(); slips > 0) {
    text += fmt::format(", slipped {} times by {:.3f} s in all", slips, status.at("slip_s").get<double>());
  }
  if (const auto code = status.at("exit_code").get<int>(); code != 0) {
    text += fmt::format("\nfailed with exit code {}: {}", code, status.at("message").get<std::string>());
  }
  if (status.contains("missing")) text += "\nwaiting for the hello of " + names(status["missing"]);
  return text + "\n";
}

}  // namespace

std::string status_text(const json& status) {
  std::string text = run_line(status);
  const json& participants = status.at("participants");
  if (participants.empty()) return text;
  std::size_t width = 11;
  for (const json& p : participants) width = std::max(width, p.at("name").get<std::string>().size());
  text += fmt::format("{:<{}}  {:>10}  {:>8}  {:>10}  {:>6}  {}\n", "participant", width, "next (s)", "cost (s)",
                      "grants", "late", "now");
  for (const json& p : participants) {
    const std::string waits = names(p.at("waiting_on"));
    const std::string now = p.at("running").get<bool>() ? "running" : waits.empty() ? "idle" : "waits for " + waits;
    text += fmt::format("{:<{}}  {:>10}  {:>8.3f}  {:>10}  {:>6}  {}\n", p.at("name").get<std::string>(), width,
                        time_text(p.at("next_ns")), p.at("cost_s").get<double>(), p.at("grants").get<std::uint64_t>(),
                        p.at("late_events").get<std::uint64_t>(), now);
  }
  return text;
}

}  // namespace ensonify::clock_tool
