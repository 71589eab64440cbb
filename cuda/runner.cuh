// Bodies as kernels.
#pragma once

#include "cuda/queue.cuh"
#include "graph/device/dispatch.hpp"

#include <cstring>

namespace locus::cuda {

constexpr unsigned kItemThreads = 256;
constexpr unsigned kItemBlocksPerMultiprocessor = 8;

template <typename Body>
__global__ void __launch_bounds__(kItemThreads) item_kernel(const __grid_constant__ Body body) {
    const uint64_t count = body.count();
    const uint64_t stride = uint64_t{gridDim.x} * blockDim.x;
    for (uint64_t i = uint64_t{blockIdx.x} * blockDim.x + threadIdx.x; i < count; i += stride)
        body(i);
}

extern __shared__ __align__(16) unsigned char block_memory[];

template <typename Body>
struct Block {
    typename Body::Shared &shared;
    typename Body::Local &local;

    __device__ uint64_t index() const { return blockIdx.x; }
    __device__ unsigned char *memory() const { return block_memory; }
    template <typename Phase>
    __device__ void each(Phase &&phase) {
        phase(threadIdx.x, local);
        __syncthreads();
    }
};

template <typename Body>
__global__ void __launch_bounds__(Body::threads) block_kernel(const __grid_constant__ Body body) {
    __shared__ typename Body::Shared shared;
    typename Body::Local local;
    Block<Body> block{shared, local};
    body(block);
}

struct Runner {
    Queue &queue;
    Message *why;
    uint64_t *resident; // null: launch

    template <typename Body>
    int32_t take(const Launch &launch, Body *&body) {
        static_assert(sizeof(Body) <= 4096, "more than the parameters of a kernel may hold");
        if (launch.body_bytes != sizeof(Body)) {
            std::snprintf(why->text, sizeof why->text, "the body of kernel %u has %llu bytes, not %llu",
                          static_cast<unsigned>(launch.kernel), static_cast<unsigned long long>(launch.body_bytes),
                          static_cast<unsigned long long>(sizeof(Body)));
            return LOCUS_E_INTERNAL;
        }
        body = static_cast<Body *>(const_cast<void *>(launch.body));
        return LOCUS_OK;
    }

    template <typename Body>
    int32_t items(const Launch &launch) {
        Body *body = nullptr;
        if (const int32_t status = take(launch, body); status != LOCUS_OK)
            return status;
        const uint64_t needed = (launch.items + kItemThreads - 1) / kItemThreads;
        const uint64_t most = static_cast<uint64_t>(queue.multiprocessors) * kItemBlocksPerMultiprocessor;
        const auto blocks = static_cast<unsigned>(needed < most ? needed : most);
        if (resident != nullptr) {
            *resident = blocks;
            return LOCUS_OK;
        }
        return start(item_kernel<Body>, blocks, kItemThreads, 0, *body);
    }

    template <typename Body>
    int32_t blocks(const Launch &launch) {
        Body *body = nullptr;
        if (const int32_t status = take(launch, body); status != LOCUS_OK)
            return status;
        if (launch.memory > 0)
            LOCUS_CUDA(cudaFuncSetAttribute(block_kernel<Body>, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                            static_cast<int>(launch.memory)));
        if (resident != nullptr) {
            int per_multiprocessor = 0;
            LOCUS_CUDA(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&per_multiprocessor, block_kernel<Body>,
                                                                     static_cast<int>(Body::threads), launch.memory));
            const int blocks = per_multiprocessor * queue.multiprocessors;
            *resident = blocks > 0 ? static_cast<uint64_t>(blocks) : 1;
            return LOCUS_OK;
        }
        return start(block_kernel<Body>, launch.items, Body::threads, launch.memory, *body);
    }

private:
    template <typename Body>
    int32_t start(void (*kernel)(Body), uint64_t blocks, unsigned threads, uint64_t memory, Body &body) {
        void *arguments[] = {&body};
        return report(cudaLaunchKernel(reinterpret_cast<const void *>(kernel), dim3(static_cast<unsigned>(blocks)),
                                       dim3(threads), arguments, memory, queue.stream),
                      "cudaLaunchKernel", why);
    }
};

} // namespace locus::cuda
