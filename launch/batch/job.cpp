#include "launch/batch/job.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <span>

#include "components/config/data_paths.h"
#include "components/runtime/version.h"
#include "components/terrain/tiles/file_bytes.h"

namespace ensonify::batch {
namespace {

namespace fs = std::filesystem;

/// A sum over words, each with its length, so that no two lists of words have the same.
class Sum {
 public:
  void add(const std::string& word) {
    const std::string length = std::to_string(word.size()) + ":";
    sum_.add(std::as_bytes(std::span(length)));
    sum_.add(std::as_bytes(std::span(word)));
  }
  std::string digest() { return sum_.digest().substr(0, 16); }

 private:
  tiles::Sha256 sum_;
};

void for_texts(const ConfigNode& node, const std::function<void(const std::string&)>& each) {
  if (node.is_scalar()) each(node.scalar);
  for (const ConfigNode& item : node.items) for_texts(item, each);
  for (const auto& entry : node.entries) for_texts(entry.value, each);
}

/// Existing files that the launch and its scenario name, in order.
std::set<std::string> files_of(const Launch& launch) {
  const std::vector<std::string> folders{fs::path(launch.file).parent_path().string(),
                                         fs::path(launch.scenario.path).parent_path().string()};
  std::set<std::string> files;
  const auto look = [&](const std::string& text) {
    std::error_code ignored;
    const std::string found = text.empty() ? "" : find_data(text, folders);
    if (!found.empty() && fs::is_regular_file(found, ignored)) files.insert(found);
  };
  for_texts(launch.scenario.document.root, look);
  for (const ProcessSpec& process : launch.processes) {
    for_texts(process.config.root, look);
    for (const std::string& word : process.argv) look(word);
  }
  return files;
}

void add_programs(const Launch& launch, const std::string& program_folder, Sum& sum) {
  std::set<std::string> programs{"conductor"};
  for (const ProcessSpec& process : launch.processes) {
    if (!process.component.empty()) programs.insert(process.component);
  }
  for (const std::string& program : programs) {
    const std::string path = program_folder + "/ensonify-" + program;
    sum.add(fs::exists(path) ? tiles::sha256_of_file(path) : program);
  }
}

/// A word of `after:` as it was before the output folder was put in.
std::string without_folder(std::string word, const std::string& out) {
  if (const std::size_t at = out.empty() ? std::string::npos : word.find(out); at != std::string::npos)
    word.replace(at, out.size(), "$(out)");
  return word;
}

}  // namespace

std::string id_of(const Launch& launch, const std::string& program_folder) {
  Sum sum;
  sum.add(kVersion);
  sum.add(vector_units());
  sum.add(launch.launch_text);
  for (const ExitExpectation& exit : launch.exits) {
    sum.add(exit.process);
    sum.add(std::to_string(exit.code) + "/" + std::to_string(exit.signal));
  }
  for (const AfterStep& step : launch.after) {
    for (const std::string& word : step.words) sum.add(without_folder(word, launch.options.out));
  }
  sum.add(launch.scenario.text);
  for (const std::string& file : files_of(launch)) sum.add(tiles::sha256_of_file(file));
  add_programs(launch, program_folder, sum);
  return sum.digest();
}

std::string programs_of(const Launch& launch, const std::string& program_folder) {
  Sum sum;
  add_programs(launch, program_folder, sum);
  return sum.digest();
}

/// They decide how libraries round.
std::string vector_units() {
  std::ifstream cpus("/proc/cpuinfo");
  const std::string text{std::istreambuf_iterator<char>(cpus), {}};
  return text.find(" avx512f") != std::string::npos ? "avx512" : "avx2";
}

std::string id_of(const std::vector<std::string>& words) {
  Sum sum;
  for (const std::string& word : words) sum.add(word);
  return sum.digest();
}

}  // namespace ensonify::batch
