#pragma once

#include <string>

#include "tools/graph/picture.h"

namespace ensonify::graph_tool {

/// For people: each process with what it publishes, to whom, and what it reads.
std::string to_text(const Picture& picture);
/// For Graphviz: processes are boxes, topics are arrows, delayed ones dashed.
std::string to_dot(const Picture& picture);
/// For scripts: processes, topics and edges by name; delays in ns, sizes in bytes.
std::string to_json(const Picture& picture);

}  // namespace ensonify::graph_tool
