// The kernels that ask for no weights.
#include "cuda/runner.cuh"

namespace locus::cuda {

int32_t run_plain(Queue &queue, const Launch &launch, Message *why, uint64_t *resident) {
    Runner runner{queue, why, resident};
    return device::run_plain(runner, launch);
}

} // namespace locus::cuda
