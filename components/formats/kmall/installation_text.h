#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ensonify::formats::kmall {

/// A group NAME:KEY=value;KEY=value of an installation text.
struct InstallationGroup {
  std::string name;
  std::string text;  // all behind the colon
  std::vector<std::pair<std::string, std::string>> values;
};

/// The groups in the order of the text. What has no name is left out.
std::vector<InstallationGroup> installation_groups(std::string_view text);

}  // namespace ensonify::formats::kmall
