// Large copies between the host's pageable memory and a device by way of two pinned buffers: the host fills or empties
// one while the GPU works on the other.
#pragma once

#include "cuda/queue.cuh"

namespace locus::cuda {

using device::HostCopy;

constexpr uint64_t kStagingBytes = uint64_t{4} << 20; // of a buffer, and the least that is worth one

inline void copy_on_host(const HostCopy *copy, void *to, const void *from, uint64_t bytes) {
    if (copy != nullptr)
        copy->run(copy->user, to, from, bytes);
    else
        std::memcpy(to, from, bytes);
}

inline void release_staging(Queue &queue) {
    for (cudaEvent_t &passed : queue.staging_passed) {
        if (passed != nullptr)
            cudaEventDestroy(passed);
        passed = nullptr;
    }
    cudaFreeHost(queue.staging);
    queue.staging = nullptr;
}

// Whether the queue has its buffers, which it asks for once; without them the driver copies as it can.
inline bool has_staging(Queue &queue) {
    if (queue.staging_asked)
        return queue.staging != nullptr;
    queue.staging_asked = true;
    void *pinned = nullptr;
    if (cudaHostAlloc(&pinned, 2 * kStagingBytes, cudaHostAllocDefault) == cudaSuccess) {
        queue.staging = static_cast<unsigned char *>(pinned);
        for (cudaEvent_t &passed : queue.staging_passed)
            if (cudaEventCreateWithFlags(&passed, cudaEventDisableTiming) != cudaSuccess) {
                release_staging(queue);
                break;
            }
    }
    cudaGetLastError(); // no failure: there is another way
    return queue.staging != nullptr;
}

// The part of a copy that begins at `done`, in one of the buffers.
struct Part {
    uint64_t bytes;
    unsigned char *buffer;
    cudaEvent_t passed;
};
inline Part part_at(const Queue &queue, uint64_t done, uint64_t bytes) {
    const uint64_t side = done / kStagingBytes % 2;
    return {bytes - done < kStagingBytes ? bytes - done : kStagingBytes, queue.staging + side * kStagingBytes,
            queue.staging_passed[side]};
}

// The GPU may still be at the last two parts on return.
inline int32_t upload_staged(Queue &queue, void *to, const void *from, uint64_t bytes, const HostCopy *copy,
                             Message *why) {
    for (uint64_t done = 0; done < bytes; done += kStagingBytes) {
        const Part part = part_at(queue, done, bytes);
        LOCUS_CUDA(cudaEventSynchronize(part.passed));
        copy_on_host(copy, part.buffer, static_cast<const unsigned char *>(from) + done, part.bytes);
        LOCUS_CUDA(cudaMemcpyAsync(static_cast<unsigned char *>(to) + done, part.buffer, part.bytes,
                                   cudaMemcpyHostToDevice, queue.stream));
        LOCUS_CUDA(cudaEventRecord(part.passed, queue.stream));
    }
    return LOCUS_OK;
}

inline int32_t download_staged(Queue &queue, void *to, const void *from, uint64_t bytes, const HostCopy *copy,
                               Message *why) {
    const auto begin = [&](uint64_t at) {
        const Part part = part_at(queue, at, bytes);
        LOCUS_CUDA(cudaMemcpyAsync(part.buffer, static_cast<const unsigned char *>(from) + at, part.bytes,
                                   cudaMemcpyDeviceToHost, queue.stream));
        LOCUS_CUDA(cudaEventRecord(part.passed, queue.stream));
        return int32_t{LOCUS_OK};
    };
    if (const int32_t status = begin(0); status != LOCUS_OK)
        return status;
    for (uint64_t done = 0; done < bytes; done += kStagingBytes) {
        const uint64_t next = done + kStagingBytes;
        if (const int32_t status = next < bytes ? begin(next) : LOCUS_OK; status != LOCUS_OK)
            return status;
        const Part part = part_at(queue, done, bytes);
        LOCUS_CUDA(cudaEventSynchronize(part.passed));
        copy_on_host(copy, static_cast<unsigned char *>(to) + done, part.buffer, part.bytes);
    }
    return LOCUS_OK;
}

} // namespace locus::cuda
