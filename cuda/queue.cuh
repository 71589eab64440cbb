// What a queue of work is on a GPU: a device, a stream, memory for CUB, and pinned memory for large copies.
#pragma once

#include "cuda/check.cuh"

namespace locus::device {

struct Queue {
    int device = 0;
    int multiprocessors = 0;
    cudaStream_t stream = nullptr;
    bool own_stream = false;
    void *scratch = nullptr; // CUB's
    size_t scratch_bytes = 0;
    unsigned char *staging = nullptr;   // two buffers, see staging.cuh,
    cudaEvent_t staging_passed[2] = {}; // and when the GPU has passed each
    bool staging_asked = false;
};

} // namespace locus::device

namespace locus::cuda {

using device::Launch;
using device::Queue;

// The parts of the library that are compiled apart.
int32_t run_plain(Queue &queue, const Launch &launch, Message *why, uint64_t *resident);
int32_t run_lower(Queue &queue, const Launch &launch, Message *why, uint64_t *resident);
int32_t run_raise(Queue &queue, const Launch &launch, Message *why, uint64_t *resident);
int32_t run_relax(Queue &queue, const Launch &launch, Message *why, uint64_t *resident);
int32_t run_sibson(Queue &queue, const Launch &launch, Message *why, uint64_t *resident);
int32_t compact(Queue &queue, const uint8_t *flags, uint64_t count, uint64_t *list, uint64_t *listed, Message *why);

} // namespace locus::cuda
