#include "launch/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kernels/vehicle/runlines/runline.h"

namespace ensonify::launcher {
namespace {

constexpr double kLineEvery_s = 10.0;

std::string duration_text(double t_s) {
  const auto whole = static_cast<long>(std::ceil(t_s));
  return whole < 60     ? fmt::format("{} s", whole)
         : whole < 3600 ? fmt::format("{} min {} s", whole / 60, whole % 60)
                        : fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

std::optional<double> expected_duration_s(const Launch& launch, const World& world) {
  if (launch.duration) {
    return seconds(*launch.duration);
  }
  const Mission& mission = world.mission;
  if (mission.runlines.empty() || world.vehicles.empty()) {
    return std::nullopt;
  }
  const double radius_m = world.vehicles.front().limits.turning_radius_m;
  double length_m = 0.0;
  for (std::size_t i = 0; i < mission.runlines.size(); ++i) {
    const auto line = runlines::extended(mission.runlines[i], mission.run_in_m, 0.0);
    length_m += runlines::length_m(line);
    if (i > 0) {
      const auto& last = mission.runlines[i - 1];
      length_m += runlines::shortest_turn({last.end_enu_m, runlines::heading_rad(last)},
                                          {line.start_enu_m, runlines::heading_rad(line)}, radius_m)
                      .length_m();
    }
  }
  return length_m / mission.speed_mps;
}

std::string progress_text(double sim_s, double wall_s, std::optional<double> duration_s, const std::string& state) {
  const double rate = wall_s > 0.0 ? sim_s / wall_s : 0.0;
  std::string text = fmt::format("t {:.1f} s  {:.1f}x real time", sim_s, rate);
  if (duration_s && rate > 0.0 && sim_s > 0.0) {
    text += "  about " + duration_text(std::max(0.0, *duration_s - sim_s) / rate) + " left";
  }
  return text + "  " + state;
}

Progress::Progress(bool quiet, std::optional<double> duration_s)
    : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1), duration_s_(duration_s) {}

void Progress::show(double sim_s, double wall_s, const std::string& state) {
  if (quiet_ || (!terminal_ && wall_s < next_line_s_)) {
    return;
  }
  const std::string text = progress_text(sim_s, wall_s, duration_s_, state);
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r\033[K" : "", text, terminal_ ? "" : "\n");
  std::fflush(stderr);
  shown_ = terminal_;
  next_line_s_ = wall_s + kLineEvery_s;
}

void Progress::finish() {
  if (shown_) {
    fmt::print(stderr, "\n");
    shown_ = false;
  }
}

}  // namespace ensonify::launcher
