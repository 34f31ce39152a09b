#pragma once

#include <functional>

namespace ensonify {

/// Runs `body` and turns what it throws into an exit code and a text on standard error.
int exit_code_of(const std::function<int()>& body);

}  // namespace ensonify
