// Memory that several threads of a device work on, for kernel bodies: on a GPU its atomic instructions, on the host
// those of C++. All are relaxed: what one kernel writes is read by the next, or by the same one as a hint that may be
// stale; within a block barriers order what they must.
#pragma once

#include "core/word.hpp"

#include <cstdint>

#ifndef __CUDA_ARCH__
#include <atomic>
#include <functional>
#endif

namespace locus::device {

#ifdef __CUDA_ARCH__
// uint64_t is another type than the one CUDA's functions are declared for.
template <typename T>
using Native = std::conditional_t<sizeof(T) == 8, unsigned long long, unsigned int>;

template <typename T>
__device__ inline Native<T> *native(T *at) {
    return reinterpret_cast<Native<T> *>(at);
}
#else
// Put `value` there where it is better than what is; returns what was there.
template <typename T, typename Better>
T replace_where(T *at, T value, Better better) {
    std::atomic_ref<T> there(*at);
    T old = there.load(std::memory_order_relaxed);
    while (better(value, old) && !there.compare_exchange_weak(old, value, std::memory_order_relaxed)) {
    }
    return old;
}
#endif

// Lower *at to `value`; returns what was there.
template <typename T>
LOCUS_HD inline T atomic_min(T *at, T value) {
#ifdef __CUDA_ARCH__
    return static_cast<T>(atomicMin(native(at), static_cast<Native<T>>(value)));
#else
    return replace_where(at, value, std::less<T>());
#endif
}

// Raise it.
template <typename T>
LOCUS_HD inline T atomic_max(T *at, T value) {
#ifdef __CUDA_ARCH__
    return static_cast<T>(atomicMax(native(at), static_cast<Native<T>>(value)));
#else
    return replace_where(at, value, std::greater<T>());
#endif
}

template <typename T>
LOCUS_HD inline T atomic_add(T *at, T value) {
#ifdef __CUDA_ARCH__
    return static_cast<T>(atomicAdd(native(at), static_cast<Native<T>>(value)));
#else
    return std::atomic_ref<T>(*at).fetch_add(value, std::memory_order_relaxed);
#endif
}

// Take the next number of a counter. On a GPU the threads of a warp that come together ask once: many blocks that count
// one by one wait for each other.
LOCUS_HD inline uint32_t take_number(uint32_t *counter) {
#ifdef __CUDA_ARCH__
    const unsigned together = __activemask(), lane = threadIdx.x % 32;
    const int first = __ffs(static_cast<int>(together)) - 1;
    uint32_t number = 0;
    if (lane == static_cast<unsigned>(first))
        number = atomicAdd(counter, static_cast<unsigned>(__popc(together)));
    return __shfl_sync(together, number, first) + static_cast<uint32_t>(__popc(together & ((1u << lane) - 1)));
#else
    return atomic_add(counter, 1u);
#endif
}

// Lower *at to `value`, as above.
LOCUS_HD inline void lower_together(uint32_t *at, uint32_t value) {
#ifdef __CUDA_ARCH__
    const unsigned together = __activemask();
    const unsigned least = __reduce_min_sync(together, value);
    if (threadIdx.x % 32 == static_cast<unsigned>(__ffs(static_cast<int>(together)) - 1))
        atomicMin(at, least);
#else
    atomic_min(at, value);
#endif
}

template <typename T>
LOCUS_HD inline T atomic_or(T *at, T bits) {
#ifdef __CUDA_ARCH__
    return static_cast<T>(atomicOr(native(at), static_cast<Native<T>>(bits)));
#else
    return std::atomic_ref<T>(*at).fetch_or(bits, std::memory_order_relaxed);
#endif
}

template <typename T>
LOCUS_HD inline T atomic_exchange(T *at, T value) {
#ifdef __CUDA_ARCH__
    return static_cast<T>(atomicExch(native(at), static_cast<Native<T>>(value)));
#else
    return std::atomic_ref<T>(*at).exchange(value, std::memory_order_relaxed);
#endif
}

// Put `value` where `expected` is; returns what was there.
template <typename T>
LOCUS_HD inline T atomic_replace(T *at, T expected, T value) {
#ifdef __CUDA_ARCH__
    return static_cast<T>(atomicCAS(native(at), static_cast<Native<T>>(expected), static_cast<Native<T>>(value)));
#else
    std::atomic_ref<T>(*at).compare_exchange_strong(expected, value, std::memory_order_relaxed);
    return expected;
#endif
}

// A load or store of memory that others write meanwhile: whole, and not from a cache of one multiprocessor alone.
template <typename T>
LOCUS_HD inline T load_shared(const T *at) {
#ifdef __CUDA_ARCH__
    return *static_cast<const volatile T *>(at);
#else
    return std::atomic_ref<T>(*const_cast<T *>(at)).load(std::memory_order_relaxed);
#endif
}
template <typename T>
LOCUS_HD inline void store_shared(T *at, T value) {
#ifdef __CUDA_ARCH__
    *static_cast<volatile T *>(at) = value;
#else
    std::atomic_ref<T>(*at).store(value, std::memory_order_relaxed);
#endif
}

} // namespace locus::device
