#pragma once

#include <map>
#include <string>

#include "launch/process/factory.h"

namespace ensonify {

/// Runs a whole launch in this process on the `local:` bus, one node after another, as fast as it goes: the same bytes
/// as separate processes, without sockets or threads of the runtime's. For tests, debuggers and ThreadSanitizer.
/// Foreign programs and external processes cannot take part: UserError names them. Returns the first exit code that is
/// not 0.
int run_local(const Launch& launch, const std::map<std::string, NodeFactory>& components);

/// main() of `ensonify-local`.
int local_main(int argc, char** argv, const std::map<std::string, NodeFactory>& components);

}  // namespace ensonify
