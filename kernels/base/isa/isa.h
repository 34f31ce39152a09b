#pragma once

#include <cstdint>

namespace ensonify {

/// Vector instructions of a processor. Where they are wider, reciprocals start from other approximations, so the last
/// bits of what rays hit may differ: equal runs have equal bytes on machines that use the same.
enum class Isa : std::uint8_t { kAvx2, kAvx512 };

const char* name_of(Isa isa);

/// The widest that this machine has.
Isa widest_isa();

/// What this process uses: AVX2, unless use_isa() said another before any scene was made.
Isa isa_in_use();
void use_isa(Isa isa);

}  // namespace ensonify
