// Every call of the CUDA runtime goes through here: its error becomes a status and a text.
#pragma once

#include "graph/device/table.hpp"

#include <cstdio>
#include <cstring>
#include <cuda_runtime.h>

namespace locus::cuda {

using device::Message;

// `call`: its name is told, its arguments are not.
inline int32_t report(cudaError_t error, const char *call, Message *why) {
    if (error == cudaSuccess)
        return LOCUS_OK;
    std::snprintf(why->text, sizeof why->text, "%.*s: %s (%s)", static_cast<int>(std::strcspn(call, "(")), call,
                  cudaGetErrorString(error), cudaGetErrorName(error));
    cudaGetLastError(); // an error that passes leaves no trace in later calls
    if (error == cudaErrorMemoryAllocation)
        return LOCUS_E_MEMORY;
    const bool absent = error == cudaErrorNoDevice || error == cudaErrorInsufficientDriver ||
                        error == cudaErrorInitializationError || error == cudaErrorStubLibrary ||
                        error == cudaErrorNoKernelImageForDevice || error == cudaErrorUnsupportedPtxVersion ||
                        error == cudaErrorJitCompilerNotFound || error == cudaErrorJitCompilationDisabled ||
                        error == cudaErrorSystemDriverMismatch || error == cudaErrorCompatNotSupportedOnDevice;
    return absent ? LOCUS_E_UNSUPPORTED : LOCUS_E_DEVICE;
}

} // namespace locus::cuda

// Return from the calling function unless a call succeeds; `why` is in its scope.
#define LOCUS_CUDA(call)                                                                                               \
    do {                                                                                                               \
        const int32_t status_ = ::locus::cuda::report((call), #call, why);                                             \
        if (status_ != LOCUS_OK)                                                                                       \
            return status_;                                                                                            \
    } while (false)
