#pragma once

#include <string>

namespace ensonify::graph_tool {

/// Has Graphviz draw `dot` into `file`; `format` is "svg" or "png". Throws UserError when Graphviz is not installed or
/// cannot write the file.
void render(const std::string& dot, const std::string& format, const std::string& file);

}  // namespace ensonify::graph_tool
