#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "components/config/parameter_info.h"

namespace ensonify {

/// For tests: "" when default.yaml and the table of README.md beside the test are what the list says; otherwise which
/// is not, and what it must hold.
inline std::string parameter_files_fault(const std::string& component, const ParameterList& list) {
  const std::string folder = std::getenv("ENSONIFY_FOLDER");
  const auto text_of = [&](const std::string& name) {
    std::ifstream in(folder + "/" + name, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string yaml = default_yaml(component + ": every parameter with its default", list);
  if (text_of("default.yaml") != yaml) return folder + "/default.yaml is not\n" + yaml;
  const std::string table = parameter_table(list);
  if (text_of("README.md").find(table) == std::string::npos) return folder + "/README.md lacks the table\n" + table;
  return "";
}

}  // namespace ensonify
