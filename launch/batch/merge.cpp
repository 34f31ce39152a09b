#include "launch/batch/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "launch/batch/results.h"

namespace ensonify::batch {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostNames = 10;  // in a message

/// The plan of a part, and what its jobs were run by.
struct Part {
  std::string folder, version, vector_units;
  std::vector<Job> plan;
};

Part read_part(const std::string& folder) {
  std::ifstream stream(folder + Folder::kPlan);
  const json plan = json::parse(stream, nullptr, false);
  Part part{.folder = folder};
  try {
    if (!plan.is_object() || plan.value("ensonify", "") != "plan/1" || !plan.contains("version"))
      throw UserError(folder + ": is no folder of `ensonify test`; allowed: what --out of its shards named");
    part.version = plan.at("version");
    part.vector_units = plan.at("vector_units");
    for (const json& one : plan.at("jobs")) {
      Job job{.label = one.at("label"), .id = one.at("id"), .programs = one.at("programs")};
      job.options.file = one.at("launch");
      one.at("args").get_to(job.options.args);
      one.at("sets").get_to(job.options.sets);
      part.plan.push_back(std::move(job));
    }
  } catch (const json::exception& error) {
    throw UserError(folder + Folder::kPlan + ": is not what `ensonify test` writes: " + error.what());
  }
  return part;
}

void compare(const Part& first, const Part& other) {
  if (other.version != first.version)
    throw UserError(fmt::format("{}: is of version {}, {} of {}; allowed: shards of one version", other.folder,
                                other.version, first.folder, first.version));
  if (other.vector_units != first.vector_units)
    throw UserError(
        fmt::format("{}: was run with {}, {} with {}; allowed: shards of processors with the same vector units",
                    other.folder, other.vector_units, first.folder, first.vector_units));
  const auto differs = [&](const Job& job, const std::string& why) {
    throw UserError(fmt::format("{}: holds another plan than {}: {}{}", other.folder, first.folder, job.label, why));
  };
  for (std::size_t i = 0; i < std::max(first.plan.size(), other.plan.size()); ++i) {
    if (i >= other.plan.size()) differs(first.plan[i], " is not in it");
    if (i >= first.plan.size()) differs(other.plan[i], " is in it");
    const Job &one = first.plan[i], &two = other.plan[i];
    const bool same_words = one.label == two.label && one.options.file == two.options.file &&
                            one.options.args == two.options.args && one.options.sets == two.options.sets;
    if (!same_words) differs(two, " is there in the place of " + one.label + ", or has other --arg or --set");
    if (one.programs != two.programs) differs(two, " was run by other programs: another build");
    if (one.id != two.id) differs(two, " was another launch, or a file that it names was another");
  }
}

/// The first of the names, and how many there are.
std::string listed(const std::vector<std::string>& names) {
  std::string lines;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) lines += "\n  " + names[i];
  if (names.size() > kMostNames) lines += fmt::format("\n  and {} more", names.size() - kMostNames);
  return lines;
}

}  // namespace

Shards read_shards(const std::vector<std::string>& folders) {
  std::vector<Part> parts;
  for (const std::string& folder : folders) {
    Part part = read_part(folder);
    const bool twice = std::ranges::any_of(parts, [&](const Part& one) { return fs::equivalent(one.folder, folder); });
    if (twice) throw UserError(folder + ": is named twice");
    if (!parts.empty()) compare(parts.front(), part);
    parts.push_back(std::move(part));
  }
  Shards shards{parts.front().plan, {}};
  std::vector<std::string> missing, doubled;
  for (const Job& job : shards.plan) {
    std::vector<std::string> has;
    for (const Part& part : parts) {
      if (fs::exists(part.folder + "/runs/" + job.id + "/result.json")) has.push_back(part.folder);
    }
    if (has.empty()) missing.push_back(job.label);
    if (has.size() > 1) doubled.push_back(fmt::format("{}: {} and {}", job.label, has[0], has[1]));
    shards.folders.push_back(has.empty() ? "" : has.front());
  }
  if (!missing.empty())
    throw UserError(
        fmt::format("{} of {} launches are done in none of the folders; name all shards, and --resume those "
                    "that were cut short:{}",
                    missing.size(), shards.plan.size(), listed(missing)));
  if (!doubled.empty())
    throw UserError(fmt::format("{} of {} launches are done more than once; name each shard once:{}", doubled.size(),
                                shards.plan.size(), listed(doubled)));
  return shards;
}

void put_together(const Shards& shards, const std::string& out) {
  const Folder folder(out, shards.plan);
  for (std::size_t i = 0; i < shards.plan.size(); ++i) {
    const std::string from = shards.folders[i] + "/runs/" + shards.plan[i].id, to = folder.run_of(shards.plan[i]);
    std::error_code error;
    fs::copy(from, to, fs::copy_options::recursive, error);
    if (error) throw DataLost(to + ": cannot be written: " + error.message());
  }
  folder.write_table(shards.plan);
}

}  // namespace ensonify::batch
