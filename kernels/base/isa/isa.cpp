#include "kernels/base/isa/isa.h"

#include <atomic>

namespace ensonify {
namespace {

std::atomic<Isa> in_use{Isa::kAvx2};

}  // namespace

const char* name_of(Isa isa) { return isa == Isa::kAvx512 ? "avx512" : "avx2"; }

Isa widest_isa() {
  // What Embree's own code for AVX-512 needs.
  const bool all = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512vl");
  return all ? Isa::kAvx512 : Isa::kAvx2;
}

Isa isa_in_use() { return in_use; }
void use_isa(Isa isa) { in_use = isa; }

}  // namespace ensonify
