#include "tools/describe/component_facts.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include "components/config/config_error.h"
#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"
#include "components/runtime/protocol.h"
#include "components/runtime/tool.h"
#include "launch/file/launch_file.h"

namespace ensonify::describe {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string program_of(const std::string& component) { return program_folder() + "/ensonify-" + component; }

/// The text below the title, up to the next blank line, in one line.
std::string first_paragraph(const std::string& readme) {
  std::istringstream lines(readme);
  std::string paragraph;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#") || (line.empty() && paragraph.empty())) continue;
    if (line.empty()) break;
    paragraph += (paragraph.empty() ? "" : " ") + line;
  }
  return paragraph;
}

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

struct Answer {
  int status = -1;
  std::string text;
};

Answer run(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) command += quoted(word) + " ";
  Answer answer;
  std::FILE* pipe = ::popen((command + "2>&1").c_str(), "r");
  if (!pipe) return answer;
  char buffer[4096];
  for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) answer.text.append(buffer, got);
  answer.status = ::pclose(pipe);
  return answer;
}

/// The project's own launch files, the demonstration first.
std::vector<std::string> example_launches() {
  std::vector<std::string> files;
  for (const std::string& root : data_roots()) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(fs::path(root) / "launch", none)) {
      if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
    if (!files.empty()) break;
  }
  std::sort(files.begin(), files.end(), [](const std::string& a, const std::string& b) {
    const auto key = [](const std::string& f) { return std::pair(!f.ends_with("/demo.yaml"), f); };
    return key(a) < key(b);
  });
  return files;
}

struct Example {
  std::string launch;
  std::string process;
};

std::vector<Example> examples_of(const std::string& component) {
  std::vector<Example> examples;
  for (const std::string& file : example_launches()) {
    try {
      const Launch launch = read_launch({.file = file});
      for (const ProcessSpec& process : launch.processes) {
        if (process.component == component) examples.push_back({file, process.name});
      }
    } catch (const ConfigError&) {  // it asks for arguments
    }
  }
  return examples;
}

void ask_for_ports(ComponentFacts& facts) {
  const auto examples = examples_of(facts.name);
  if (examples.empty())
    facts.no_ports_because = "its ports follow from its configuration, and no launch file here uses it";
  for (const Example& example : examples) {
    const Answer answer =
        run({program_of(facts.name), "--check", "--launch", example.launch, "--name", example.process});
    if (answer.status != 0) {
      facts.no_ports_because = answer.text;
      continue;
    }
    const Declaration declaration = protocol::read_declaration(answer.text);
    facts.example = example.process + " in launch/" + fs::path(example.launch).filename().string();
    facts.outs = declaration.outs;
    facts.lives = declaration.lives;
    facts.ins = declaration.ins;
    facts.declares = declaration.declares;
    facts.no_ports_because.clear();
    return;
  }
}

}  // namespace

std::vector<std::string> component_names() {
  std::set<std::string> names;
  for (const std::string& root : data_roots()) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(fs::path(root) / "components", none)) {
      const std::string name = entry.path().filename().string();
      const bool has_program = ::access(program_of(name).c_str(), X_OK) == 0;
      if (has_program && fs::exists(entry.path() / "default.yaml")) names.insert(name);
    }
  }
  return {names.begin(), names.end()};
}

std::string parameters_as(const std::string& form, const std::string& component) {
  const Answer answer = run({program_of(component), "--parameters", form});
  if (answer.status != 0) throw UserError("ensonify-" + component + " --parameters " + form + ": " + answer.text);
  return answer.text;
}

std::map<std::string, std::string> component_schemas() {
  std::map<std::string, std::string> schemas;
  for (const std::string& component : component_names()) schemas[component] = parameters_as("schema", component);
  return schemas;
}

ComponentFacts facts_of(const std::string& component) {
  ComponentFacts facts;
  facts.name = component;
  facts.default_yaml = read_file(find_data("components/" + component + "/default.yaml", {}));
  facts.about = first_paragraph(read_file(find_data("components/" + component + "/README.md", {})));
  ask_for_ports(facts);
  return facts;
}

}  // namespace ensonify::describe
