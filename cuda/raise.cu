// The visits of bricks that raise words.
#include "cuda/runner.cuh"

namespace locus::cuda {

int32_t run_raise(Queue &queue, const Launch &launch, Message *why, uint64_t *resident) {
    Runner runner{queue, why, resident};
    return device::run_visit<true>(runner, launch);
}

} // namespace locus::cuda
