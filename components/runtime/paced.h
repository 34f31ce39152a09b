#pragma once

#include <map>
#include <string>

namespace ensonify {

/// Fact of a run whose sim time is to follow wall time. It does so from when everybody has run its event at 0: what
/// takes long the first time is best done there. What is published does not depend on it.
inline constexpr const char* kPacedFact = "paced";

inline bool is_paced(const std::map<std::string, std::string>& facts) { return facts.contains(kPacedFact); }

}  // namespace ensonify
