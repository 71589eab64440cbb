// The emulated device as a library that liblocus opens in the place of liblocus_cuda.so. EMULATED_CALLS in the
// environment: after so many calls every one fails.
#include "tests/emulated/device.hpp"

#include <cstdlib>

const locus::device::Table *LOCUS_DEVICE_ENTRY(void) noexcept {
    if (const char *calls = std::getenv("EMULATED_CALLS")) {
        locus::device::emulated::settings().calls_left = std::atoll(calls);
        locus::device::emulated::settings().keeps_failing = true;
    }
    return &locus::device::emulated::table();
}
