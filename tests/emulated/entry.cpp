// The emulated device as a library that liblocus opens in the place of liblocus_cuda.so.
#include "tests/emulated/device.hpp"

const locus::device::Table *LOCUS_DEVICE_ENTRY(void) noexcept { return &locus::device::emulated::table(); }
