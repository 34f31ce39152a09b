#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace ensonify::plan {

/// One `ensonify plan <verb>`: its command line, and what it does.
struct Verb {
  CLI::App* app;
  std::function<int()> run;
};

Verb add_lines(CLI::App& parent);
Verb add_speed(CLI::App& parent);
Verb add_sidescan(CLI::App& parent);
Verb add_import(CLI::App& parent);

}  // namespace ensonify::plan
