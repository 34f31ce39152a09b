#pragma once

/// Before a function of loops over columns: it is compiled twice, for AVX2 and for AVX-512, and the processor's is
/// called. Both give the same bits: an element goes through the same operations, and none are fused.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ENSONIFY_WIDE [[gnu::target_clones("default", "arch=x86-64-v4")]]
#else
#define ENSONIFY_WIDE
#endif
