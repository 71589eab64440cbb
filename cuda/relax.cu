// The thesis' relax kernel.
#include "cuda/runner.cuh"

namespace locus::cuda {

int32_t run_relax(Queue &queue, const Launch &launch, Message *why, uint64_t *resident) {
    Runner runner{queue, why, resident};
    return device::run_relax(runner, launch);
}

} // namespace locus::cuda
