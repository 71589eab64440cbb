// The visits of bricks that lower words.
#include "cuda/runner.cuh"

namespace locus::cuda {

int32_t run_lower(Queue &queue, const Launch &launch, Message *why, uint64_t *resident) {
    Runner runner{queue, why, resident};
    return device::run_visit<false>(runner, launch);
}

} // namespace locus::cuda
