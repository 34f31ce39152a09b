#include "launch/batch/results.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/version.h"

namespace ensonify::batch {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Whole on disk under its name, or not there at all.
void write_whole(const std::string& file, const std::string& text) {
  const std::string part = file + ".part";
  launcher::write_text(part, text);
  const int fd = ::open(part.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = fd >= 0 && ::fsync(fd) == 0;
  if (fd >= 0) ::close(fd);
  if (!synced || std::rename(part.c_str(), file.c_str()) != 0)
    throw DataLost(file + ": cannot be written: " + std::strerror(errno));
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string plan_text(const std::vector<Job>& plan) {
  ordered_json jobs = ordered_json::array();
  for (const Job& job : plan) {
    jobs.push_back({{"id", job.id},
                    {"label", job.label},
                    {"launch", job.options.file},
                    {"args", job.options.args},
                    {"sets", job.options.sets}});
    if (!job.programs.empty()) jobs.back()["programs"] = job.programs;
  }
  ordered_json all = {{"ensonify", "plan/1"}};
  const bool comparable = !plan.empty() && !plan.front().programs.empty();
  if (comparable) all.update({{"version", kVersion}, {"vector_units", vector_units()}});
  all["jobs"] = std::move(jobs);
  return all.dump(2) + "\n";
}

/// As CSV has it.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::size_t Result::failed() const {
  return static_cast<std::size_t>(std::ranges::count_if(expectations, [](const auto& one) { return !one.ok; }));
}

Folder::Folder(const std::string& path, const std::vector<Job>& plan) : path_(path) {
  launcher::make_folder(path + "/runs");
  const std::string file = path + kPlan, text = plan_text(plan);
  if (fs::exists(file) && text_of(file) != text)
    throw UserError(path + ": holds another plan (" + file + "); choose another folder with --out, or remove it");
  write_whole(file, text);
}

std::optional<Result> Folder::result_of(const Job& job) const {
  const auto json = ordered_json::parse(text_of(run_of(job) + "/result.json"), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  Result result{.id = job.id, .label = job.label};
  result.exit_code = json.value("exit_code", int{kExitDied});
  result.sim_s = json.value("sim_s", 0.0);
  result.wall_s = json.value("wall_s", 0.0);
  result.culprit = json.value("culprit", "");
  result.message = json.value("message", "");
  for (const auto& one : json.value("expect", ordered_json::array()))
    result.expectations.push_back(
        {one.value("name", ""), one.value("ok", false), one.value("t_s", 0.0), one.value("message", "")});
  return result;
}

void Folder::done(const Job& job, int exit_code, const std::string& run_json, double wall_s) const {
  const auto said = ordered_json::parse(run_json, nullptr, false);
  ordered_json result = {{"id", job.id}, {"label", job.label}, {"exit_code", exit_code}, {"wall_s", wall_s}};
  if (said.is_object()) {
    result["sim_s"] = said.value("sim_s", 0.0);
    for (const char* key : {"culprit", "message"}) {
      if (said.contains(key) && said[key].is_string()) result[key] = said[key];
    }
    result["expect"] = said.value("expect", ordered_json::array());
  }
  launcher::make_folder(run_of(job));
  write_whole(run_of(job) + "/result.json", result.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

void Folder::undo(const Job& job) const {
  std::error_code ignored;
  fs::remove(run_of(job) + "/result.json", ignored);
}

void Folder::forget(const std::string& path) {
  const auto plan = ordered_json::parse(text_of(path + kPlan), nullptr, false);
  if (!plan.is_object() || plan.value("ensonify", "") != "plan/1") return;
  std::error_code ignored;
  for (const char* own : {"/runs", "/results.csv", "/plan.json"}) fs::remove_all(path + own, ignored);
}

void Folder::write_table(const std::vector<Job>& plan) const {
  std::string table = "id,label,exit_code,expectations,failed,sim_s,message\n";
  for (const Job& job : plan) {
    const auto result = result_of(job);
    if (!result) continue;
    table += fmt::format("{},{},{},{},{},{:.3f},{}\n", job.id, cell(job.label), result->exit_code,
                         result->expectations.size(), result->failed(), result->sim_s, cell(result->message));
  }
  write_whole(path_ + "/results.csv", table);
}

std::vector<Job> shard_of(const std::vector<Job>& plan, std::size_t part, std::size_t parts) {
  std::vector<Job> own;
  for (std::size_t i = part - 1; i < plan.size(); i += parts) own.push_back(plan[i]);
  return own;
}

}  // namespace ensonify::batch
