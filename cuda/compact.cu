// Stream compaction by CUB, alone in this file because it compiles slowly.
#include "cuda/queue.cuh"

#include <cub/device/device_select.cuh>
#include <thrust/iterator/counting_iterator.h>

namespace locus::cuda {

int32_t compact(Queue &queue, const uint8_t *flags, uint64_t count, uint64_t *list, uint64_t *listed, Message *why) {
    const thrust::counting_iterator<uint64_t> numbers(0);
    const auto items = static_cast<int64_t>(count);
    size_t needed = 0;
    LOCUS_CUDA(cub::DeviceSelect::Flagged(nullptr, needed, numbers, flags, list, listed, items, queue.stream));
    if (needed > queue.scratch_bytes) {
        LOCUS_CUDA(cudaStreamSynchronize(queue.stream)); // the old scratch memory may be in use
        void *const old = queue.scratch;
        queue.scratch = nullptr;
        queue.scratch_bytes = 0;
        LOCUS_CUDA(cudaFree(old));
        LOCUS_CUDA(cudaMalloc(&queue.scratch, needed));
        queue.scratch_bytes = needed;
    }
    LOCUS_CUDA(cub::DeviceSelect::Flagged(queue.scratch, needed, numbers, flags, list, listed, items, queue.stream));
    return LOCUS_OK;
}

} // namespace locus::cuda
