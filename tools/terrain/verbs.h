#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ensonify::terrain_tool {

/// One verb of `ensonify terrain`: asked for when its subcommand was parsed; run gives the exit code.
struct Verb {
  CLI::App* app;
  std::function<int()> run;
};

Verb add_build(CLI::App& parent);
Verb add_facets(CLI::App& parent);
Verb add_grid(CLI::App& parent);
Verb add_import(CLI::App& parent);
Verb add_info(CLI::App& parent);
Verb add_lod(CLI::App& parent);
Verb add_marks(CLI::App& parent);
Verb add_mesh(CLI::App& parent);
Verb add_plot(CLI::App& parent);
Verb add_sample(CLI::App& parent);
Verb add_truth(CLI::App& parent);
Verb add_verify(CLI::App& parent);

}  // namespace ensonify::terrain_tool
