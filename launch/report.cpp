#include "launch/report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "kernels/vehicle/runlines/runline.h"
#include "launch/junit.h"
#include "launch/process/profiled_node.h"

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

std::vector<Expectation> read_expectations(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) {
    return {};
  }
  try {
    std::vector<Expectation> expectations;
    for (const auto& item : nlohmann::json::parse(stream)) {
      expectations.push_back({item.at("name"), item.at("ok"), item.value("t_s", 0.0), item.value("message", "")});
    }
    return expectations;
  } catch (const nlohmann::json::exception& error) {
    throw ExitError(kExitDied, file + ": is not what expect writes: " + error.what());
  }
}

std::vector<Loss> losses_in(const nlohmann::json& report) {
  std::vector<Loss> losses;
  for (const auto& participant : report.value("participants", nlohmann::json::array())) {
    if (!participant.contains("lost")) continue;
    const auto& lost = participant["lost"];
    losses.push_back({participant["name"], 1e-9 * lost["at_ns"].get<double>(), lost["why"]});
  }
  return losses;
}

std::optional<ClockReport> read_clock_report(const std::string& out) {
  std::ifstream stream(out + "/clock.json");
  const auto reported = nlohmann::json::parse(stream, nullptr, false);
  if (!reported.is_object()) {
    return std::nullopt;
  }
  ClockReport report{reported.value("sim_s", 0.0),  reported.value("exit_code", 0),
                     reported.value("culprit", ""), reported.value("message", ""),
                     losses_in(reported),           {}};
  for (const auto& participant : reported.value("participants", nlohmann::json::array())) {
    if (const int code = participant.value("exit_code", 0); code != 0) report.exit_codes[participant["name"]] = code;
  }
  return report;
}

void remove_reports(const std::string& out) {
  std::error_code ignored;
  for (const char* stale : {"/expect.json", "/clock.json", "/run.json", "/profile.json"}) {
    std::filesystem::remove(out + stale, ignored);
  }
  std::filesystem::remove_all(profile_folder(out), ignored);
}

std::string junit_xml(const RunReport& report) {
  std::string expectations, processes;
  std::size_t failed = 0, died = 0;
  for (const auto& item : report.expectations) {
    failed += item.ok ? 0 : 1;
    expectations += junit::test_case("expect", item.name, item.t_s,
                                     item.ok                ? ""
                                     : item.message.empty() ? "not fulfilled"
                                                            : item.message);
  }
  for (const auto& process : report.processes) {
    died += process.fault ? 1 : 0;
    processes += junit::test_case("process", process.name, process.cpu_s, process.fault ? process.fault->message : "");
  }
  if (report.cause) {  // also what no single process did, such as Ctrl-C
    ++died;
    processes += junit::test_case("run", "run", report.wall_s, report.cause->culprit + " " + report.cause->message);
  }
  return junit::document(
      junit::test_suite("expect", report.expectations.size(), failed, expectations) +
      junit::test_suite("processes", report.processes.size() + (report.cause ? 1 : 0), died, processes));
}

std::string json_text(const RunReport& report) {
  using nlohmann::json;
  json processes = json::array();
  for (const auto& process : report.processes) {
    json item{{"name", process.name}, {"state", process.state}};
    if (process.ending) {
      item["exit_code"] = process.ending->signal == 0 ? json(process.ending->exit_code) : json(nullptr);
      item["signal"] = process.ending->signal == 0 ? json(nullptr) : json(process.ending->signal);
    }
    if (process.hosted) item["hosted"] = true;
    if (process.ending && !process.hosted) {
      item["max_rss_kib"] = process.max_rss_kib;
      item["cpu_s"] = process.cpu_s;
    }
    if (process.loss) item["lost"] = {{"at_s", process.loss->at_s}, {"message", process.loss->why}};
    processes.push_back(std::move(item));
  }
  json expectations = json::array();
  for (const auto& item : report.expectations) {
    expectations.push_back({{"name", item.name}, {"ok", item.ok}, {"t_s", item.t_s}, {"message", item.message}});
  }
  json out{{"exit_code", report.code},
           {"culprit", report.cause ? json(report.cause->culprit) : json(nullptr)},
           {"message", report.cause ? json(report.cause->message) : json(nullptr)},
           {"isa", report.isa},
           {"sim_s", report.sim_s},
           {"wall_s", report.wall_s},
           {"real_time_factor", report.wall_s > 0.0 ? report.sim_s / report.wall_s : 0.0},
           {"processes", processes},
           {"expect", expectations}};
  if (report.profiles.json != "null") out["profile"] = json::parse(report.profiles.json);
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw UserError(folder + ": cannot be made: " + error.message() + "; choose another folder with --out");
  }
}

void write_text(const std::string& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  if (!stream) {
    throw DataLost(file + ": cannot be written: " + std::strerror(errno));
  }
}

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
