// Sibson's weights.
#include "cuda/runner.cuh"

namespace locus::cuda {

int32_t run_sibson(Queue &queue, const Launch &launch, Message *why, uint64_t *resident) {
    Runner runner{queue, why, resident};
    return device::run_sibson(runner, launch);
}

} // namespace locus::cuda
