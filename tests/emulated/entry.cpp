// The emulated device as a library that liblocus opens in the place of liblocus_cuda.so. In the environment:
// EMULATED_CALLS, after so many calls every one fails; EMULATED_STREAM, the number of the only stream it works on.
#include "tests/emulated/device.hpp"

#include <cstdlib>

const locus::device::Table *LOCUS_DEVICE_ENTRY(void) noexcept {
    if (const char *calls = std::getenv("EMULATED_CALLS")) {
        locus::device::emulated::settings().calls_left = std::atoll(calls);
        locus::device::emulated::settings().keeps_failing = true;
    }
    if (const char *stream = std::getenv("EMULATED_STREAM"))
        locus::device::emulated::settings().stream = reinterpret_cast<void *>(std::strtoull(stream, nullptr, 10));
    return &locus::device::emulated::table();
}
