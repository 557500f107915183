#pragma once

/// Before a function that works on many lanes side by side: GCC compiles it twice, with all that is inlined into it, and the program takes the
/// version for wider vectors where the processor has them. Nothing is contracted, so both give the same bits. Never inlined: inside another loop GCC
/// unrolls such loops before it would make vectors of them. (Sanitizers are not up yet when the version is chosen.)
#if !defined(UMBRAGE_PLAIN_VECTORS) && defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define UMBRAGE_VECTOR_UNITS [[gnu::noinline, gnu::target_clones("avx2", "default")]]
#else
#define UMBRAGE_VECTOR_UNITS [[gnu::noinline]]
#endif
