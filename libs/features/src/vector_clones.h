/** Hot loops are compiled twice, for the x86-64 baseline that Debian builds for and for AVX2; the
 *  machine takes what it can run. Integers, or floats lane by lane without fused products, so that
 *  both give the same. */
#pragma once
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RGBD_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define RGBD_VECTOR_CLONES
#endif
